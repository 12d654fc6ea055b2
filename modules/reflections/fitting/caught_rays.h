// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/jobs/executor.h"
#include "modules/reflections/culling/placed.h"
#include "modules/reflections/culling/rooms.h"
#include "modules/reflections/fitting/reflected_rays.h"

namespace gloam {

/// Greatest distance, in metres along the ray, between a proxy and the surface that it stands for.
inline constexpr double kCatchDistance_m = 0.25;

/// How proxies meet reflected rays.
struct CaughtRays {
  std::uint64_t rays = 0;
  std::uint64_t surface_rays = 0;  ///< rays that hit a surface
  std::uint64_t in_rooms = 0;      ///< of these: the surface is in a room whose proxies the eye sees reflected
  std::uint64_t caught = 0;        ///< of these: the first proxy is within kCatchDistance_m of the surface
  std::uint64_t misplaced = 0;     ///< rays, also to the sky, whose first proxy is elsewhere
  /// Share of the rays to surfaces that are caught; 0 if there are none.
  [[nodiscard]] double share() const;
};

/// Distance along the ray to the front of the proxy; kNoHit if the ray misses it.
[[nodiscard]] double hit_distance(const PlacedProxy& proxy, const ReflectedRay& ray);

/// A proxy that a ray meets.
struct RayMeeting {
  std::uint32_t ray = 0;
  float distance_m = 0.0f;
};

/// For each proxy the rays that meet its front, by ascending ray. Rooms decide which proxies the eye of a ray sees
/// reflected (choose_rooms, receiver_bands).
[[nodiscard]] std::vector<std::vector<RayMeeting>> meet_rays(std::span<const PlacedProxy> proxies,
                                                             std::span<const PlacedRoom> rooms,
                                                             std::span<const ReflectedRay> rays, JobExecutor& jobs);

/// Whether a proxy at this distance stands for what the ray hits.
[[nodiscard]] inline bool is_caught(const ReflectedRay& ray, double distance_m) {
  return distance_m - ray.hit_m <= kCatchDistance_m && ray.hit_m - distance_m <= kCatchDistance_m;
}

[[nodiscard]] CaughtRays caught_rays(std::span<const PlacedProxy> proxies, std::span<const PlacedRoom> rooms,
                                     std::span<const ReflectedRay> rays, JobExecutor& jobs);

}  // namespace gloam
