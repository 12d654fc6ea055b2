// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/pairs/bounds.h"

#include <algorithm>
#include <span>

#include "engine/render/packing/mesh_packing.h"

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
  const std::size_t count = assets.meshes.size();
  if (meshes.version == assets.version && meshes.revision == assets.revision() && meshes.deformed.size() == count)
    return;
  if (meshes.version != assets.version || meshes.deformed.size() > count) meshes.deformed.clear();
  std::vector<std::uint32_t> changed;
  for (std::uint32_t m = 0; m < count; ++m)
    if (m >= meshes.deformed.size() || assets.revision(AssetKind::mesh, m) > meshes.revision) changed.push_back(m);
  meshes.version = assets.version;
  meshes.revision = assets.revision();
  meshes.deformed.resize(count);
  jobs.parallel_for(changed.size(), 1, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Mesh& mesh = assets.meshes[changed[i]];
      meshes.deformed[changed[i]] = deforms(mesh) ? bounds_of_primitives(mesh) : std::vector<GpuPrimitive>();
    }
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
