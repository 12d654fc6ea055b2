// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/culling/placed.h"

#include <algorithm>
#include <cmath>

#include "engine/math/finite.h"

namespace gloam {
namespace {

/// Least sine of the angle between a proxy's sides, and least sine between a room's edges and faces. Below it rounding
/// decides the direction of the normal.
constexpr double kLeastSine = 1e-9;

bool is_finite_placement(const dmat4& m) {
  return is_finite(dvec3(m[0])) && is_finite(dvec3(m[1])) && is_finite(dvec3(m[2])) && is_finite(dvec3(m[3]));
}

}  // namespace

ProxyPlacement place_proxy(Entity entity, const IbrProxy& proxy, const dmat4& world_from_node, PlacedProxy& placed) {
  if (!std::isfinite(proxy.size_m.x) || !std::isfinite(proxy.size_m.y) || !is_finite_placement(world_from_node))
    return ProxyPlacement::not_finite;
  placed.entity = entity;
  placed.center = dvec3(world_from_node[3]);
  placed.half_u = dvec3(world_from_node[0]) * (0.5 * static_cast<double>(proxy.size_m.x));
  placed.half_v = dvec3(world_from_node[1]) * (0.5 * static_cast<double>(proxy.size_m.y));
  const dvec3 across = glm::cross(placed.half_u, placed.half_v);
  const double area = glm::length(across);
  const double sides = glm::length(placed.half_u) * glm::length(placed.half_v);
  if (!std::isfinite(area) || !std::isfinite(sides)) return ProxyPlacement::not_finite;
  if (!(proxy.size_m.x > 0.0f && proxy.size_m.y > 0.0f && area > kLeastSine * sides)) return ProxyPlacement::no_area;
  placed.normal = across / area;
  if (glm::dot(placed.normal, dvec3(world_from_node[2])) < 0.0) placed.normal = -placed.normal;
  return ProxyPlacement::placed;
}

bool place_room(Entity entity, const IbrRoom& room, const ReflectingHeights* heights, const dmat4& world_from_node,
                PlacedRoom& placed) {
  if (!is_finite(room.size_m) || !is_finite_placement(world_from_node)) return false;
  if (!(room.size_m.x > 0.0f && room.size_m.y > 0.0f && room.size_m.z > 0.0f)) return false;
  dvec3 half[3];
  for (int i = 0; i < 3; ++i) half[i] = dvec3(world_from_node[i]) * (0.5 * static_cast<double>(room.size_m[i]));
  const double volume = glm::dot(half[0], glm::cross(half[1], half[2]));
  const double edges = glm::length(half[0]) * glm::length(half[1]) * glm::length(half[2]);
  if (!std::isfinite(edges) || !(std::abs(volume) > kLeastSine * edges)) return false;
  placed.entity = entity;
  placed.center = dvec3(world_from_node[3]);
  for (std::size_t i = 0; i < 3; ++i) placed.to_face[i] = glm::cross(half[(i + 1) % 3], half[(i + 2) % 3]) / volume;
  if (!std::ranges::all_of(placed.to_face, [](const dvec3& v) { return is_finite(v); })) return false;
  placed.floor_m = placed.center.y - std::abs(half[0].y) - std::abs(half[1].y) - std::abs(half[2].y);
  placed.volume_m3 = 8.0 * std::abs(volume);
  placed.screen_space = room.tiers == IbrRoomTiers::all || room.tiers == IbrRoomTiers::ssr_cube;
  placed.proxies = room.tiers == IbrRoomTiers::all || room.tiers == IbrRoomTiers::ibr_cube;
  placed.heights_m.clear();
  if (heights == nullptr) return true;
  const std::size_t count = std::min<std::size_t>(heights->count, heights->heights_m.size());
  for (std::size_t i = 0; i < count; ++i)
    if (std::isfinite(heights->heights_m[i])) placed.heights_m.push_back(static_cast<double>(heights->heights_m[i]));
  std::ranges::sort(placed.heights_m);
  return true;
}

}  // namespace gloam
