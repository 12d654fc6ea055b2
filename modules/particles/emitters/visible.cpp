// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/visible.h"

#include <algorithm>
#include <cmath>

#include "engine/math/frustum.h"

namespace gloam {
namespace {

/// Sets the depths of the box; false if it lies before the near plane.
bool set_depths(const WorldBox& box, const RenderView& view, VisibleEmitter& visible) {
  const mat4& m = view.view_from_relative;
  const dvec3 forward(-static_cast<double>(m[0][2]), -static_cast<double>(m[1][2]), -static_cast<double>(m[2][2]));
  const double middle = glm::dot(forward, 0.5 * (box.min + box.max) - view.position);
  const double half = glm::dot(glm::abs(forward), 0.5 * (box.max - box.min));
  const double rounding = 1e-5 * (std::abs(middle) + half) + 1e-4;
  visible.near_m = std::max(middle - half - rounding, static_cast<double>(view.near_m));
  visible.far_m = middle + half + rounding;
  return visible.far_m > visible.near_m;
}

/// Keeps the nearest emitters.
void limit_emitters(VisibleEmitters& found) {
  std::vector<VisibleEmitter>& emitters = found.emitters;
  if (emitters.size() <= kMostVisibleEmitters) return;
  std::ranges::sort(emitters, [](const VisibleEmitter& a, const VisibleEmitter& b) {
    return a.near_m != b.near_m ? a.near_m < b.near_m : a.emitter < b.emitter;
  });
  found.left_out = emitters.size() - kMostVisibleEmitters;
  emitters.resize(kMostVisibleEmitters);
  std::ranges::sort(emitters, {}, &VisibleEmitter::emitter);
}

}  // namespace

VisibleEmitters find_visible_emitters(std::span<const PlacedEmitter> emitters, const RenderView& view,
                                      std::int64_t step) {
  VisibleEmitters found;
  found.step = step;
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    const PlacedEmitter& emitter = emitters[i];
    VisibleEmitter visible;
    visible.emitter = static_cast<std::uint32_t>(i);
    visible.live = live_particles(emitter.rate, static_cast<double>(emitter.values.lifetime_s), step);
    found.alive += visible.live.count;
    if (visible.live.count == 0 || !(emitter.largest_m > 0.0f)) continue;
    const Aabb box{vec3(emitter.bounds.min - view.position), vec3(emitter.bounds.max - view.position)};
    if (!may_intersect(view.frustum, box) || !set_depths(emitter.bounds, view, visible)) continue;
    found.emitters.push_back(visible);
  }
  limit_emitters(found);
  for (const VisibleEmitter& visible : found.emitters) found.particles += visible.live.count;
  return found;
}

void particle_view_system(Resource<const EmitterSet> set, Resource<const SceneClock> clock,
                          ViewResource<const RenderView> view, ViewResource<VisibleEmitters> visible) {
  *visible = find_visible_emitters(set->emitters, *view, particle_step(clock->time_s));
}

}  // namespace gloam
