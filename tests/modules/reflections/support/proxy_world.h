// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/scene/components.h"
#include "modules/lights/components.h"
#include "modules/reflections/proxies/rows.h"
#include "tests/modules/reflections/culling/proxy_oracle.h"

namespace gloam::test {

/// Relative error of a dot product of unit vectors in float: five roundings of its own, and those of its operands.
inline constexpr double kDotError = 8.0 / 16777216.0;

/// A ray against a proxy, in double.
struct RayMeeting {
  bool met = false;
  bool decided = true;  ///< rounding cannot change `met`
  double distance_m = 0.0;
  double slack_m = 0.0;   ///< error that rounding may cause in the distance, and in the place on the proxy
  dvec2 uv = dvec2(0.0);  ///< of the captured image
  [[nodiscard]] double uv_slack(const IbrProxy& proxy) const {
    return slack_m / std::min(static_cast<double>(proxy.size_m.x), static_cast<double>(proxy.size_m.y));
  }
};
/// `error`: relative error of the origin, of the direction and of dot products with them.
[[nodiscard]] inline RayMeeting meet_in_double(const SceneProxy& proxy, const dvec3& origin, const dvec3& direction,
                                               double error = kDotError) {
  // The point in the node's space is solved for directly: node · (x, y, 0) = origin + t · direction.
  const dmat4& m = proxy.world_from_node;
  const glm::dmat3 system{dvec3(m[0]), dvec3(m[1]), -direction};
  const dvec3 solved = glm::inverse(system) * (origin - dvec3(m[3]));
  const dvec2 size(proxy.proxy.size_m), at = dvec2(solved) / size;  // −0.5…0.5
  const double facing = glm::dot(glm::normalize(dvec3(m[2])), direction);
  RayMeeting meeting;
  meeting.distance_m = solved.z;
  meeting.uv = {0.5 + at.x, 0.5 - at.y};
  // The distance is a quotient of two dot products: of the normal with the way to the centre, and with the direction.
  // Both are off by `error` times the lengths in them. At grazing incidence, the small divisor makes more of that.
  const double lengths = glm::length(dvec3(m[3])) + glm::length(origin) + std::abs(solved.z) + size.x + size.y;
  meeting.slack_m = error * lengths / std::max(std::abs(facing), 1e-12);
  const dvec2 beside_edge = glm::abs(glm::abs(at) - 0.5) * size;
  const bool beside_x = std::abs(at.x) > 0.5 && beside_edge.x > meeting.slack_m;
  const bool beside_y = std::abs(at.y) > 0.5 && beside_edge.y > meeting.slack_m;
  const bool away = facing > error || (solved.z < 0.0 && solved.z < -meeting.slack_m);
  const bool sure = facing < -1e-6 - error && solved.z > meeting.slack_m && std::abs(at.x) < 0.5 &&
                    std::abs(at.y) < 0.5 && std::min(beside_edge.x, beside_edge.y) > meeting.slack_m;
  meeting.met = facing < 0.0 && solved.z > 0.0 && std::max(std::abs(at.x), std::abs(at.y)) <= 0.5;
  meeting.decided = sure || beside_x || beside_y || away;
  return meeting;
}

/// The proxies and rooms of a scene as entities of a world, with captures of one flat layer per proxy.
class ProxyWorld {
 public:
  explicit ProxyWorld(const ProxyScene& scene) {
    world.register_component<IbrProxy>();
    world.register_component<Light>();
    world.register_component<WorldTransform>();
    for (const SceneProxy& p : scene.proxies) {
      const Entity entity = world.create(p.proxy, WorldTransform{p.world_from_node});
      PlacedProxy placed;
      if (place_proxy(entity, p.proxy, p.world_from_node, placed) != ProxyPlacement::placed) continue;
      set.proxies.push_back(placed);
      captures.proxy_entities.push_back(entity);
    }
    for (const SceneRoom& r : scene.rooms) {
      PlacedRoom placed;
      if (place_room(kNoEntity, r.room, r.heights ? &*r.heights : nullptr, r.world_from_node, placed))
        set.rooms.push_back(placed);
    }
    captures.proxies = {4, 1, static_cast<std::uint32_t>(captures.proxy_entities.size()), {}};
  }
  [[nodiscard]] ProxyTiles tiles(const RenderView& view, const ProxyTileSettings& settings = {}) const {
    ProxyTiles tiles;
    build_proxy_tiles(set, view, settings, *make_serial_executor(), tiles);
    return tiles;
  }
  [[nodiscard]] std::vector<shaders::ProxyRow> rows(const RenderView& view, bool all) const {
    std::vector<vec4> cells;
    return proxy_rows(world, view, set, tiles(view), captures, {}, all, cells);
  }

  World world;
  ProxySet set;
  ReflectionCaptures captures;
};

}  // namespace gloam::test
