// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/idle_knobs.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/render/scene/scene_triangles.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/transmission.h"
#include "modules/lights/components.h"
#include "modules/shadows/components.h"
#include "modules/shadows/knobs.h"

namespace gloam {
namespace {

/// A local light with a width that casts shadows.
struct WideLamp {
  dvec3 position = dvec3(0.0);
  double near = 0.0;  ///< distance within which a blocker may be near
};

/// near_blockers.glsl: a blocker is near if half the lamp's width is more than 0.3 of its depth in the map. In the
/// corner of a cube face the depth is 1/√3 of the distance.
std::vector<WideLamp> wide_lamps(const World& world) {
  constexpr double kNear = 1.7320508 / 0.3;
  std::vector<WideLamp> lamps;
  world.view<const Light, const WorldTransform, Maybe<const ShadowCaster>>().each(
      [&](const Light& light, const WorldTransform& transform, const ShadowCaster* caster) {
        const bool casts = caster == nullptr || caster->enabled;
        if (!casts || light.kind == LightKind::directional || !(light.width_m > 0.0f)) return;
        lamps.push_back({dvec3(transform.matrix[3]), kNear * 0.5 * static_cast<double>(light.width_m)});
      });
  return lamps;
}

bool has_wide_light(const World& world) {
  bool found = !wide_lamps(world).empty();
  world.view<const Light, Maybe<const ShadowCaster>>().each([&](const Light& light, const ShadowCaster* caster) {
    const bool casts = caster == nullptr || caster->enabled;
    found = found || (casts && light.kind == LightKind::directional && light.apparent_angle > 0.0f);
  });
  return found;
}

/// From a point to the nearest point of the box, which is placed by an affine matrix; at most the true distance.
double distance_to_box(const dvec3& point, const Aabb& box, const dmat4& world_from_box) {
  const dvec3 middle = 0.5 * (dvec3(box.min) + dvec3(box.max)), half = 0.5 * (dvec3(box.max) - dvec3(box.min));
  const dvec3 at(world_from_box * dvec4(middle, 1.0));
  dvec3 extent(0.0);
  for (int axis = 0; axis < 3; ++axis) extent += glm::abs(dvec3(world_from_box[axis])) * half[axis];
  return glm::length(glm::max(glm::abs(point - at) - extent, dvec3(0.0)));
}

}  // namespace

bool has_near_blocker(const World& world) {
  const std::vector<WideLamp> lamps = wide_lamps(world);
  if (lamps.empty()) return false;
  bool found = world.view<const CasterVolume>().size() > 0;
  const SceneAssets& assets = world.resource<SceneAssets>();
  world.view<const MeshInstance, const WorldTransform>().each(
      [&](const MeshInstance& instance, const WorldTransform& transform) {
        if (found || !instance.casts_shadows || instance.mesh >= assets.meshes.size()) return;
        const Aabb& box = assets.meshes[instance.mesh].bounds;
        found = std::ranges::any_of(lamps, [&](const WideLamp& lamp) {
          return !(distance_to_box(lamp.position, box, dmat4(transform.matrix)) > lamp.near);
        });
      });
  return found;
}

std::string idle_shadow_knob(const World& world, std::string_view knob, const FrameCounters& counters) {
  if (knob == kSubsurfaceBacks.name && !lets_light_through(world)) return "no material lets light through";
  if (knob == kShadowLodTexels.name && !may_have_levels(world)) return std::string(kNoLevels);
  constexpr std::string_view kOfWidth[] = {kShadowNear.name, kShadowNearDirections.name, kShadowMips.name,
                                           kShadowMipOperator.name, kSquareShadowKernel.name};
  if (std::ranges::find(kOfWidth, knob) != std::end(kOfWidth) && !has_wide_light(world))
    return "no light that casts shadows has a width";
  if ((knob == kShadowNear.name || knob == kShadowNearDirections.name) && !has_near_blocker(world))
    return "no lamp has a near blocker";
  const auto all = counters.find("shadows.tile_lights"), filtered = counters.find("shadows.tile_lights_filtered");
  if (all == counters.end() || filtered == counters.end()) return {};
  if (all->second <= 0.0) return "no surface in view is in reach of a light that casts shadows";
  const auto kept = counters.find("shadows.tile_lights_kept");
  if (kept != counters.end() && kept->second > 0.0) return {};  // what they were made by does not show
  return filtered->second > 0.0 ? "" : "each light lights all of a tile in view or nothing of it";
}

}  // namespace gloam
