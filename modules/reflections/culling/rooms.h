// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/math/types.h"
#include "modules/reflections/culling/placed.h"

namespace gloam {

// Lengths in scene_unit()s.

/// A point this far outside a room's face still counts as inside: a camera on a face is in both rooms.
inline constexpr double kRoomFaceSlack = 1e-5;
/// Receivers this far from a reflecting height, or below the floor, still count. A puddle's depth in the depth image is
/// rounded, and scenes often put the floor of a room exactly on the ground.
inline constexpr double kReceiverSlack = 0.01;
/// Reflection extension without a room: how far below the lower of eye and proxy receivers may lie.
inline constexpr double kOpenExtension = 1000.0;

/// World heights (Y) of receivers, metres. lowest_m ≤ highest_m; highest_m may be infinite.
struct ReceiverBand {
  double lowest_m = 0.0;
  double highest_m = 0.0;
};

/// Heights at which one proxy may be reflected. count 0: the proxy is in none of the chosen rooms.
struct ReceiverBands {
  static constexpr std::size_t kCapacity = 4;  ///< bands of a shaders::ProxyRow: tiles and pixels follow the same rule
  std::array<ReceiverBand, kCapacity> bands{};
  std::size_t count = 0;
  [[nodiscard]] std::span<const ReceiverBand> all() const { return std::span(bands).first(count); }
};

/// Whether a world position is in the room. Faces are inside. unit: ProxySet::unit, here and below.
[[nodiscard]] bool contains(const PlacedRoom& room, const dvec3& position, double unit = 1.0);

/// The rooms that contain the camera: indices into `rooms`, ascending. Of overlapping and nested rooms all are chosen.
/// Empty if the camera is in no room, also if there are no rooms: then the world outside all rooms is the camera's
/// room.
void choose_rooms(std::span<const PlacedRoom> rooms, const dvec3& camera, std::vector<std::uint32_t>& chosen,
                  double unit = 1.0);

/// The room whose tiers a view has: of the camera's rooms the one with the smallest volume, of equal ones the first.
/// Null if the camera is in no room. chosen: result of choose_rooms.
[[nodiscard]] const PlacedRoom* smallest_room(std::span<const PlacedRoom> rooms, std::span<const std::uint32_t> chosen);

/// Heights of the receivers that may show the proxy to the camera. chosen: result of choose_rooms.
///
/// A proxy belongs to the rooms that hold its centre. It is reflected if it shares a chosen room with the camera. Its
/// bands are then those of all shared rooms: a band around each reflecting height of the room, or, if the room states
/// none, one band from its floor up. The floor is thus the longest extension of the reflection. Bands that overlap are
/// merged; more than ReceiverBands::kCapacity bands become one.
///
/// If `chosen` is empty, proxies outside all rooms are reflected, from kOpenExtension below the eye or the proxy's
/// lowest point up.
[[nodiscard]] ReceiverBands receiver_bands(const PlacedProxy& proxy, std::span<const PlacedRoom> rooms,
                                           std::span<const std::uint32_t> chosen, const dvec3& camera,
                                           double unit = 1.0);

}  // namespace gloam
