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

struct KeptPatches {
  std::vector<VisiblePatch> patches;
  std::uint32_t in_view = 0;
};

void cull_range(std::span<const GrassPatch> patches, JobRange range, const RenderView& view,
                const PatchCulling& culling, KeptPatches& kept) {
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const GrassPatch& patch = patches[i];
    if (patch.blades == 0) continue;
    const dvec3 origin = patch.origin - view.position;
    const double nearest_m = distance_to(patch.roots, glm::conjugate(patch.turn) * -origin);
    if (!(nearest_m < static_cast<double>(patch.max_distance_m))) continue;
    Aabb box = reach_box(patch);
    box.min = vec3(dvec3(box.min) + origin);
    box.max = vec3(dvec3(box.max) + origin);
    const bool in_view = may_intersect(view.frustum, box);
    const bool casts =
        !in_view && nearest_m < static_cast<double>(culling.cast_distance_m) &&
        std::ranges::any_of(culling.lights, [&](const CastingLight& light) { return may_cast_into(view, box, light); });
    if (!in_view && !casts) continue;
    kept.in_view += in_view ? 1 : 0;
    kept.patches.push_back({static_cast<std::uint32_t>(i), static_cast<float>(nearest_m)});
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

bool may_cast_into(const RenderView& view, const Aabb& box, const CastingLight& light) {
  const vec3 center = box.center();
  const vec3 half = box.half_extent();
  const vec3 lamp = vec3(light.position - view.position);
  if (!light.directional) {
    const vec3 beside = glm::max(glm::abs(lamp - center) - half, vec3(0.0f));
    if (glm::dot(beside, beside) > light.range_m * light.range_m) return false;
  }
  // The shadow is the box, and every point p of it moved away from the light: by any multiple of the direction, or of
  // p - lamp. It is outside of a plane if the box is and no such move leads inward.
  for (const Plane& plane : view.frustum.planes) {
    const float reach = glm::dot(glm::abs(plane.normal), half);
    const float nearest = glm::dot(plane.normal, center) + reach;  // of the box, along the normal
    if (!(nearest + plane.distance < 0.0f)) continue;
    const float inward =
        light.directional ? glm::dot(plane.normal, light.direction) : nearest - glm::dot(plane.normal, lamp);
    if (inward <= 0.0f) return false;
  }
  return true;
}

VisiblePatches find_visible_patches(std::span<const GrassPatch> patches, const RenderView& view,
                                    const PatchCulling& culling, JobExecutor& jobs) {
  std::vector<KeptPatches> kept((patches.size() + kCullGrain - 1) / kCullGrain);
  jobs.parallel_for(patches.size(), kCullGrain,
                    [&](JobRange range) { cull_range(patches, range, view, culling, kept[range.ordinal]); });
  VisiblePatches visible;
  visible.cast = culling.cast_distance_m > 0.0f && !culling.lights.empty();
  for (const KeptPatches& part : kept) {
    visible.patches.insert(visible.patches.end(), part.patches.begin(), part.patches.end());
    visible.in_view += part.in_view;
  }
  std::ranges::sort(visible.patches, [](const VisiblePatch& a, const VisiblePatch& b) {
    return a.nearest_m != b.nearest_m ? a.nearest_m < b.nearest_m : a.patch < b.patch;
  });
  for (const VisiblePatch& one : visible.patches)
    visible.range_m = std::max(visible.range_m, patches[one.patch].max_distance_m);
  return visible;
}

}  // namespace gloam
