// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// IBR rooms: P. Sikachev et al., Next-Generation Rendering in Thief, GPU Pro 6, section 1.2.4. Not from the paper:
// rooms may be rotated and overlap, a room may state its reflecting heights, and proxies outside all rooms are
// reflected while the camera is outside too.
#include "modules/reflections/culling/rooms.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gloam {
namespace {

void add_band(const ReceiverBand& band, ReceiverBands& bands) {
  ReceiverBand merged = band;
  // A full list becomes one band around everything.
  const bool full = bands.count == ReceiverBands::kCapacity;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < bands.count; ++i) {
    const ReceiverBand& other = bands.bands[i];
    const bool overlaps = other.lowest_m <= merged.highest_m && merged.lowest_m <= other.highest_m;
    if (!overlaps && !full) {
      bands.bands[kept++] = other;
      continue;
    }
    merged.lowest_m = std::min(merged.lowest_m, other.lowest_m);
    merged.highest_m = std::max(merged.highest_m, other.highest_m);
  }
  bands.bands[kept++] = merged;
  bands.count = kept;
}

}  // namespace

bool contains(const PlacedRoom& room, const dvec3& position, double unit) {
  const dvec3 offset = position - room.center;
  return std::ranges::all_of(room.to_face, [&](const dvec3& to_face) {
    return std::abs(glm::dot(to_face, offset)) <= 1.0 + kRoomFaceSlack * unit * glm::length(to_face);
  });
}

void choose_rooms(std::span<const PlacedRoom> rooms, const dvec3& camera, std::vector<std::uint32_t>& chosen,
                  double unit) {
  chosen.clear();
  for (std::size_t i = 0; i < rooms.size(); ++i)
    if (contains(rooms[i], camera, unit)) chosen.push_back(static_cast<std::uint32_t>(i));
}

const PlacedRoom* smallest_room(std::span<const PlacedRoom> rooms, std::span<const std::uint32_t> chosen) {
  const PlacedRoom* smallest = nullptr;
  for (const std::uint32_t index : chosen)
    if (smallest == nullptr || rooms[index].volume_m3 < smallest->volume_m3) smallest = &rooms[index];
  return smallest;
}

ReceiverBands receiver_bands(const PlacedProxy& proxy, std::span<const PlacedRoom> rooms,
                             std::span<const std::uint32_t> chosen, const dvec3& camera, double unit) {
  constexpr double kNoEnd = std::numeric_limits<double>::infinity();
  ReceiverBands bands;
  if (chosen.empty()) {
    if (std::ranges::any_of(rooms, [&](const PlacedRoom& room) { return contains(room, proxy.center, unit); }))
      return bands;
    const double proxy_bottom = proxy.center.y - std::abs(proxy.half_u.y) - std::abs(proxy.half_v.y);
    add_band({std::min(proxy_bottom, camera.y) - kOpenExtension * unit, kNoEnd}, bands);
    return bands;
  }
  for (const std::uint32_t index : chosen) {
    const PlacedRoom& room = rooms[index];
    if (!contains(room, proxy.center, unit)) continue;
    const double slack = kReceiverSlack * unit;
    if (room.heights_m.empty()) add_band({room.floor_m - slack, kNoEnd}, bands);
    for (const double height : room.heights_m) add_band({height - slack, height + slack}, bands);
  }
  return bands;
}

}  // namespace gloam
