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

/// A ray against a proxy, in double.
struct RayMeeting {
  bool met = false;
  double distance_m = 0.0;
  dvec2 uv = dvec2(0.0);   ///< of the captured image
  bool near_edge = false;  ///< so near to an edge or to the origin that rounding may decide
  bool grazing = false;    ///< nearly parallel
};
[[nodiscard]] inline RayMeeting meet_in_double(const SceneProxy& proxy, const dvec3& origin, const dvec3& direction) {
  // The point in the node's space is solved for directly: node · (x, y, 0) = origin + t · direction.
  const dmat4& m = proxy.world_from_node;
  const glm::dmat3 system{dvec3(m[0]), dvec3(m[1]), -direction};
  const dvec3 solved = glm::inverse(system) * (origin - dvec3(m[3]));
  const dvec2 at = dvec2(solved) / dvec2(proxy.proxy.size_m);  // −0.5…0.5
  const double facing = glm::dot(glm::normalize(dvec3(m[2])), direction);
  RayMeeting meeting;
  meeting.distance_m = solved.z;
  meeting.uv = {0.5 + at.x, 0.5 - at.y};
  const double outside = std::max(std::abs(at.x), std::abs(at.y)) - 0.5;
  const double slack = 2e-4 + 1e-5 * std::abs(solved.z);
  meeting.near_edge = std::abs(outside) < 1e-3 || std::abs(solved.z) < slack;
  meeting.grazing = std::abs(facing) < 1e-2;
  meeting.met = facing < 0.0 && solved.z > 0.0 && outside <= 0.0;
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
    return proxy_rows(world, view, set, tiles(view), captures, all);
  }

  World world;
  ProxySet set;
  ReflectionCaptures captures;
};

}  // namespace gloam::test
