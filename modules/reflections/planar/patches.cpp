// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/planar/patches.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/ecs/view.h"
#include "engine/math/finite.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "modules/reflections/materials.h"
#include "modules/reflections/scene_unit.h"

namespace gloam {
namespace {

constexpr double kLeastUp = 0.999;  // of a triangle's normal: 2.6°
constexpr float kSmooth = 0.38f;    // as in shaders/reflections/surfaces_api.glsl

/// How much of a mirror a material is, 0…1. Its textures are not read.
double mirror_weight(const Material& material) {
  if (reflective(material) != Reflective::mirror) return 0.0;
  const bool textured = material.metallic_roughness_texture.texture != kNone;
  const float roughness = std::clamp((material.roughness - kSmooth) / (kTooRoughForMirrors - kSmooth), 0.0f, 1.0f);
  const float smooth = textured ? 0.5f : 1.0f - roughness * roughness * (3.0f - 2.0f * roughness);
  const float derived = (1.0f - material.roughness) * (0.5f + 0.5f * material.metallic);
  const float reflectivity = material.reflectivity >= 0.0f ? material.reflectivity : textured ? 0.5f : derived;
  return static_cast<double>(smooth * reflectivity);
}

/// Adds the primitive's horizontal triangles that face up, with both_sides also those that face down, a patch each.
void add_triangles(const Primitive& primitive, double weight, bool both_sides, const dmat4& world_from_mesh,
                   double thickness, std::vector<MirrorPatch>& triangles) {
  const auto corner = [&](std::size_t i) {
    return dvec3(world_from_mesh * dvec4(dvec3(primitive.positions[primitive.indices[i]]), 1.0));
  };
  const double side = glm::determinant(glm::dmat3(world_from_mesh)) < 0.0 ? -1.0 : 1.0;
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    const dvec3 a = corner(i), b = corner(i + 1), c = corner(i + 2);
    const dvec3 normal = side * glm::cross(b - a, c - a);
    const double length = glm::length(normal), up = both_sides ? std::abs(normal.y) : normal.y;
    if (!std::isfinite(length) || !(up > kLeastUp * length)) continue;
    MirrorPatch patch{glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), (a.y + b.y + c.y) / 3.0,
                      0.5 * length * weight};
    if (patch.max.y - patch.min.y <= thickness && patch.mirrors_m2 > 0.0) triangles.push_back(patch);
  }
}

/// Joins triangles from the lowest one up, as long as they fit into one plane.
std::vector<MirrorPatch> joined(std::vector<MirrorPatch> triangles, double thickness) {
  std::ranges::sort(triangles, {}, [](const MirrorPatch& patch) { return patch.min.y; });
  std::vector<MirrorPatch> patches;
  for (const MirrorPatch& triangle : triangles) {
    if (patches.empty() || triangle.max.y - patches.back().min.y > thickness) {
      patches.push_back(triangle);
      continue;
    }
    MirrorPatch& patch = patches.back();
    const double sum = patch.mirrors_m2 + triangle.mirrors_m2;
    patch.height_m += (triangle.height_m - patch.height_m) * (triangle.mirrors_m2 / sum);
    patch.mirrors_m2 = sum;
    patch.min = glm::min(patch.min, triangle.min);
    patch.max = glm::max(patch.max, triangle.max);
  }
  return patches;
}

std::vector<MirrorPatch> patches_of(const SceneAssets& assets, std::uint32_t mesh, const dmat4& world_from_mesh,
                                    double thickness) {
  std::vector<MirrorPatch> triangles;
  for (const Primitive& primitive : assets.meshes[mesh].primitives) {
    const bool known = primitive.material < assets.materials.size();
    const double weight = mirror_weight(known ? assets.materials[primitive.material] : Material{});
    const bool both_sides = known && assets.materials[primitive.material].double_sided;
    if (weight > 0.0) add_triangles(primitive, weight, both_sides, world_from_mesh, thickness, triangles);
  }
  return joined(std::move(triangles), thickness);
}

bool is_mirror(const SceneAssets& assets, std::uint32_t mesh) {
  return std::ranges::any_of(assets.meshes[mesh].primitives, [&](const Primitive& primitive) {
    return primitive.material < assets.materials.size() && mirror_weight(assets.materials[primitive.material]) > 0.0;
  });
}

/// Whether the mesh or one of its materials changed after `revision`.
bool has_changed(const SceneAssets& assets, std::uint32_t mesh, std::uint64_t revision) {
  return assets.revision(AssetKind::mesh, mesh) > revision ||
         std::ranges::any_of(assets.meshes[mesh].primitives, [&](const Primitive& primitive) {
           return assets.revision(AssetKind::material, primitive.material) > revision;
         });
}

}  // namespace

bool MirrorPatches::update_meshes(const SceneAssets& assets) {
  changed_.assign(assets.meshes.size(), 0);
  if (version_ == assets.version && revision_ == assets.revision() && mirrors_.size() == assets.meshes.size())
    return false;
  const bool all = version_ != assets.version || mirrors_.size() > assets.meshes.size();
  const std::size_t known = all ? 0 : mirrors_.size();
  mirrors_.resize(assets.meshes.size());
  bool any = all;
  for (std::uint32_t m = 0; m < mirrors_.size(); ++m) {
    changed_[m] = m >= known || has_changed(assets, m, revision_) ? 1 : 0;
    if (changed_[m] == 0) continue;
    const std::uint8_t before = m < known ? mirrors_[m] : 0;
    mirrors_[m] = is_mirror(assets, m) ? 1 : 0;
    any = any || before != 0 || mirrors_[m] != 0;
  }
  version_ = assets.version;
  revision_ = assets.revision();
  return any;
}

void MirrorPatches::update(const World& world) {
  const SceneAssets& assets = world.resource<SceneAssets>();
  const double unit = scene_unit(world);
  const bool same_unit = std::exchange(unit_, unit) == unit;
  bool changed = update_meshes(assets) || !same_unit;
  std::size_t count = 0;
  world.view<const MeshInstance, const WorldTransform, Maybe<const MorphInstance>>().each(
      [&](Entity entity, const MeshInstance& instance, const WorldTransform& transform, const MorphInstance* morph) {
        if (instance.mesh >= mirrors_.size() || mirrors_[instance.mesh] == 0) return;
        if (instance.skin != kNone || morph != nullptr) return;
        if (count == instances_.size()) instances_.emplace_back();
        Instance& known = instances_[count++];
        if (known.entity == entity && known.mesh == instance.mesh && known.world_from_mesh == transform.matrix &&
            changed_[instance.mesh] == 0 && same_unit)
          return;
        known = {entity, instance.mesh, transform.matrix,
                 patches_of(assets, instance.mesh, transform.matrix, kPlaneThickness * unit)};
        ++searched_;
        changed = true;
      });
  changed = changed || count != instances_.size();
  instances_.resize(count);
  if (!changed) return;
  all_.clear();
  for (const Instance& instance : instances_) all_.insert(all_.end(), instance.patches.begin(), instance.patches.end());
}

}  // namespace gloam
