// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/math/types.h"
#include "modules/reflections/components.h"

namespace gloam {

/// A reflection proxy in world space, metres: the points center + s · half_u + t · half_v with s and t in −1…1. It is a
/// parallelogram if the node's matrix is sheared. Only rays against the normal hit it.
struct PlacedProxy {
  Entity entity = kNoEntity;
  dvec3 center = dvec3(0.0);
  dvec3 half_u = dvec3(0.0);
  dvec3 half_v = dvec3(0.0);
  dvec3 normal = dvec3(0.0, 0.0, 1.0);  ///< unit length, to the side of the node's +Z
  friend bool operator==(const PlacedProxy&, const PlacedProxy&) = default;

  /// In the order of the outline.
  [[nodiscard]] std::array<dvec3, 4> corners() const {
    return {center - half_u - half_v, center + half_u - half_v, center + half_u + half_v, center - half_u + half_v};
  }
};

/// An IBR room in world space, metres: a box, or a parallelepiped if the node's matrix is sheared.
struct PlacedRoom {
  Entity entity = kNoEntity;
  dvec3 center = dvec3(0.0);
  /// For each pair of faces: dot(to_face, p − center) is −1 and 1 on the faces. 1 / length(to_face) is the distance
  /// from the centre to a face.
  std::array<dvec3, 3> to_face{};
  double floor_m = 0.0;           ///< world height of the box's lowest point
  double volume_m3 = 0.0;         ///< of the box
  bool screen_space = true;       ///< IbrRoom::tiers has screen space
  bool proxies = true;            ///< and proxies
  std::vector<double> heights_m;  ///< finite values of ReflectingHeights, ascending; empty: every height ≥ floor_m
  friend bool operator==(const PlacedRoom&, const PlacedRoom&) = default;
};

/// All proxies and rooms of the world, each sorted by entity index; a world resource written by system ibr_proxies.
/// `unit` is set before it runs.
struct ProxySet {
  std::vector<PlacedProxy> proxies;
  std::vector<PlacedRoom> rooms;
  std::uint32_t not_finite = 0;      ///< proxies left out because of NaN or infinity in their size or matrix
  std::uint32_t no_area = 0;         ///< proxies left out because their area is zero
  std::uint32_t unusable_rooms = 0;  ///< rooms left out: NaN, infinity or no volume
  std::uint64_t version = 0;         ///< changes whenever `proxies`, `rooms` or `unit` change
  double unit = 1.0;                 ///< scene_unit(): what the lengths of culling/rooms.h are multiples of
};

enum class ProxyPlacement : std::uint8_t { placed, not_finite, no_area };

/// Places a proxy at its node. `placed` is undefined unless the result is ProxyPlacement::placed.
[[nodiscard]] ProxyPlacement place_proxy(Entity entity, const IbrProxy& proxy, const dmat4& world_from_node,
                                         PlacedProxy& placed);

/// Places a room at its node. heights: null, or the room's reflecting heights. False, with `placed` undefined, if the
/// size or the matrix is not finite or the box has no volume.
[[nodiscard]] bool place_room(Entity entity, const IbrRoom& room, const ReflectingHeights* heights,
                              const dmat4& world_from_node, PlacedRoom& placed);

}  // namespace gloam
