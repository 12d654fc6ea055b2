// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/pairs/bounds.h"

#include <algorithm>
#include <span>

#include "engine/render/scene/mesh_packing.h"

namespace gloam {
namespace {

bool deforms(const Mesh& mesh) {
  return std::ranges::any_of(mesh.primitives,
                             [](const Primitive& p) { return !p.joints.empty() || !p.morph_targets.empty(); });
}

std::vector<GpuPrimitive> bounds_of_primitives(const Mesh& mesh) {
  std::vector<GpuPrimitive> primitives;
  for (const Primitive& source : mesh.primitives) {
    if (source.positions.empty()) continue;
    GpuPrimitive& primitive = primitives.emplace_back();
    const std::vector<PackedInfluence> influences = pack_influences(source);
    primitive.skinned = !influences.empty();
    primitive.morph_targets = static_cast<std::uint32_t>(source.morph_targets.size());
    primitive.bounds = source.bounds;
    primitive.joint_bounds = joint_bounds(source, influences);
    primitive.morph_bounds = morph_bounds(source);
  }
  return primitives;
}

const JointMatrices::Range* range_of(const JointMatrices& joints, Entity entity) {
  const auto range =
      std::lower_bound(joints.ranges.begin(), joints.ranges.end(), entity.index,
                       [](const JointMatrices::Range& r, std::uint32_t index) { return r.instance.index < index; });
  const bool found = range != joints.ranges.end() && range->instance == entity && range->count > 0;
  return found ? &*range : nullptr;
}

}  // namespace

void update_closeup_meshes(const SceneAssets& assets, JobExecutor& jobs, CloseupMeshes& meshes) {
  if (meshes.version == assets.version && meshes.deformed.size() == assets.meshes.size()) return;
  meshes.version = assets.version;
  meshes.deformed.assign(assets.meshes.size(), {});
  jobs.parallel_for(assets.meshes.size(), 1, [&](JobRange range) {
    for (std::size_t m = range.begin; m < range.end; ++m)
      if (deforms(assets.meshes[m])) meshes.deformed[m] = bounds_of_primitives(assets.meshes[m]);
  });
}

void add_posed(const PosedScene& scene, Entity entity, const MeshInstance& instance, const dmat4& world_from_node,
               const MorphInstance* morph, BoxSum& sum) {
  if (instance.mesh >= scene.assets.meshes.size()) return;
  const auto add = [&](const WorldBox& box) {
    if (box.known())
      sum.add(box);
    else
      sum.unknown = true;
  };
  const std::vector<GpuPrimitive>& deformed = scene.meshes.deformed[instance.mesh];
  if (deformed.empty()) {
    const Aabb& bounds = scene.assets.meshes[instance.mesh].bounds;
    if (!bounds.empty()) add(world_box(bounds, world_from_node));
    return;
  }
  const JointMatrices::Range* joints = instance.skin == kNone ? nullptr : range_of(scene.joints, entity);
  const std::span<const float> weights(scene.weights.values);
  for (const GpuPrimitive& primitive : deformed) {
    Aabb reach{vec3(0.0f), vec3(0.0f)};
    if (morph != nullptr && primitive.morph_targets > 0 && morph->count >= primitive.morph_targets) {
      if (std::size_t{morph->first} + primitive.morph_targets > weights.size()) {
        sum.unknown = true;
        return;
      }
      reach = morph_reach(primitive, weights.subspan(morph->first, primitive.morph_targets));
    }
    const bool posed = primitive.skinned && joints != nullptr;
    add(posed ? posed_box(primitive, scene.joints, *joints, reach)
              : world_box({primitive.bounds.min + reach.min, primitive.bounds.max + reach.max}, world_from_node));
  }
}

}  // namespace gloam
