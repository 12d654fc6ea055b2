// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/lod/visible_patches.h"

#include <algorithm>
#include <glm/ext/quaternion_common.hpp>

#include "engine/math/frustum.h"

namespace gloam {
namespace {

constexpr std::size_t kCullGrain = 1024;

double distance_to(const Aabb& box, const dvec3& at) {
  return glm::length(glm::max(glm::max(dvec3(box.min) - at, at - dvec3(box.max)), dvec3(0.0)));
}

void cull_range(std::span<const GrassPatch> patches, JobRange range, const RenderView& view,
                const PatchCulling& culling, std::vector<VisiblePatch>& kept) {
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const GrassPatch& patch = patches[i];
    if (patch.blades == 0) continue;
    const dvec3 origin = patch.origin - view.position;
    const double nearest_m = distance_to(patch.roots, glm::conjugate(patch.turn) * -origin);
    if (!(nearest_m < static_cast<double>(patch.max_distance_m))) continue;
    Aabb box = reach_box(patch);
    box.min = vec3(dvec3(box.min) + origin);
    box.max = vec3(dvec3(box.max) + origin);
    if (nearest_m >= static_cast<double>(culling.cast_distance_m) && !may_intersect(view.frustum, box)) continue;
    kept.push_back({static_cast<std::uint32_t>(i), static_cast<float>(nearest_m)});
  }
}

/// Box of the roots, relative to the origin, along the world's axes. A patch without roots keeps its empty box.
Aabb root_box(const GrassPatch& patch) {
  if (patch.turn == dquat(1.0, 0.0, 0.0, 0.0) || patch.roots.empty()) return patch.roots;
  Aabb box;
  for (int i = 0; i < 8; ++i) {
    const dvec3 corner((i & 1) != 0 ? patch.roots.max.x : patch.roots.min.x,
                       (i & 2) != 0 ? patch.roots.max.y : patch.roots.min.y,
                       (i & 4) != 0 ? patch.roots.max.z : patch.roots.min.z);
    box.grow(vec3(patch.turn * corner));
  }
  return box;
}

}  // namespace

Aabb reach_box(const GrassPatch& patch) {
  Aabb box = root_box(patch);
  box.min -= vec3(patch.reach_m);
  box.max += vec3(patch.reach_m);
  return box;
}

VisiblePatches find_visible_patches(std::span<const GrassPatch> patches, const RenderView& view,
                                    const PatchCulling& culling, JobExecutor& jobs) {
  std::vector<std::vector<VisiblePatch>> kept((patches.size() + kCullGrain - 1) / kCullGrain);
  jobs.parallel_for(patches.size(), kCullGrain,
                    [&](JobRange range) { cull_range(patches, range, view, culling, kept[range.ordinal]); });
  VisiblePatches visible;
  for (const std::vector<VisiblePatch>& part : kept)
    visible.patches.insert(visible.patches.end(), part.begin(), part.end());
  std::ranges::sort(visible.patches, [](const VisiblePatch& a, const VisiblePatch& b) {
    return a.nearest_m != b.nearest_m ? a.nearest_m < b.nearest_m : a.patch < b.patch;
  });
  for (const VisiblePatch& one : visible.patches)
    visible.range_m = std::max(visible.range_m, patches[one.patch].max_distance_m);
  return visible;
}

}  // namespace gloam
