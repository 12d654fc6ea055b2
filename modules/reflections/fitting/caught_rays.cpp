// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/fitting/caught_rays.h"

#include <algorithm>
#include <cmath>

namespace gloam {
namespace {

/// Rays with the same eye see the same proxies. Rays of one eye follow each other.
struct EyeRays {
  std::size_t first = 0;
  std::size_t end = 0;
  std::vector<std::uint32_t> rooms;  ///< choose_rooms()
};

std::vector<EyeRays> group_by_eye(std::span<const PlacedRoom> rooms, std::span<const ReflectedRay> rays) {
  std::vector<EyeRays> groups;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (groups.empty() || rays[groups.back().first].eye != rays[i].eye) {
      groups.push_back({.first = i, .end = i, .rooms = {}});
      choose_rooms(rooms, rays[i].eye, groups.back().rooms);
    }
    groups.back().end = i + 1;
  }
  return groups;
}

/// A proxy with what its intersections need.
struct ProxyPlane {
  dvec3 normal;
  double offset = 0.0;
  dvec3 to_u;  ///< dot with a point relative to the centre: −1…1 inside
  dvec3 to_v;
};

ProxyPlane plane_of(const PlacedProxy& proxy) {
  ProxyPlane plane;
  plane.normal = proxy.normal;
  plane.offset = glm::dot(proxy.normal, proxy.center);
  const dvec3 across = glm::cross(proxy.half_u, proxy.half_v);
  const double area2 = glm::dot(across, across);
  plane.to_u = glm::cross(proxy.half_v, across) / area2;
  plane.to_v = glm::cross(across, proxy.half_u) / area2;
  return plane;
}

double hit_distance(const ProxyPlane& plane, const dvec3& center, const ReflectedRay& ray) {
  const double along = glm::dot(plane.normal, ray.direction);
  if (!(along < 0.0)) return kNoHit;
  const double distance = (plane.offset - glm::dot(plane.normal, ray.receiver)) / along;
  if (!(distance > 0.0)) return kNoHit;
  const dvec3 at = ray.receiver + ray.direction * distance - center;
  const bool inside = std::abs(glm::dot(plane.to_u, at)) <= 1.0 && std::abs(glm::dot(plane.to_v, at)) <= 1.0;
  return inside ? distance : kNoHit;
}

/// Whether a proxy at the point could be reflected for the eye, at some height.
bool is_in_rooms(const dvec3& point, const EyeRays& eye, std::span<const PlacedRoom> rooms) {
  if (eye.rooms.empty())
    return std::ranges::none_of(rooms, [&](const PlacedRoom& room) { return contains(room, point); });
  return std::ranges::any_of(eye.rooms, [&](std::uint32_t index) { return contains(rooms[index], point); });
}

bool shows_at(const ReceiverBands& bands, double height_m) {
  return std::ranges::any_of(
      bands.all(), [&](const ReceiverBand& band) { return band.lowest_m <= height_m && height_m <= band.highest_m; });
}

}  // namespace

double CaughtRays::share() const {
  return surface_rays > 0 ? static_cast<double>(caught) / static_cast<double>(surface_rays) : 0.0;
}

double hit_distance(const PlacedProxy& proxy, const ReflectedRay& ray) {
  return hit_distance(plane_of(proxy), proxy.center, ray);
}

std::vector<std::vector<RayMeeting>> meet_rays(std::span<const PlacedProxy> proxies, std::span<const PlacedRoom> rooms,
                                               std::span<const ReflectedRay> rays, JobExecutor& jobs) {
  const std::vector<EyeRays> eyes = group_by_eye(rooms, rays);
  std::vector<std::vector<RayMeeting>> meetings(proxies.size());
  constexpr std::size_t kGrain = 8;
  jobs.parallel_for(proxies.size(), kGrain, [&](JobRange range) {
    for (std::size_t p = range.begin; p < range.end; ++p) {
      const ProxyPlane plane = plane_of(proxies[p]);
      for (const EyeRays& eye : eyes) {
        const ReceiverBands bands = receiver_bands(proxies[p], rooms, eye.rooms, rays[eye.first].eye);
        if (bands.count == 0) continue;
        for (std::size_t r = eye.first; r < eye.end; ++r) {
          const double distance = hit_distance(plane, proxies[p].center, rays[r]);
          if (std::isfinite(distance) && shows_at(bands, rays[r].receiver.y))
            meetings[p].push_back({static_cast<std::uint32_t>(r), static_cast<float>(distance)});
        }
      }
    }
  });
  return meetings;
}

CaughtRays caught_rays(std::span<const PlacedProxy> proxies, std::span<const PlacedRoom> rooms,
                       std::span<const ReflectedRay> rays, JobExecutor& jobs) {
  std::vector<double> nearest(rays.size(), kNoHit);
  for (const std::vector<RayMeeting>& met : meet_rays(proxies, rooms, rays, jobs))
    for (const RayMeeting& meeting : met)
      nearest[meeting.ray] = std::min(nearest[meeting.ray], static_cast<double>(meeting.distance_m));
  CaughtRays result;
  result.rays = rays.size();
  for (const EyeRays& eye : group_by_eye(rooms, rays))
    for (std::size_t i = eye.first; i < eye.end; ++i)
      if (std::isfinite(rays[i].hit_m))
        result.in_rooms += is_in_rooms(rays[i].receiver + rays[i].direction * rays[i].hit_m, eye, rooms) ? 1 : 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool hits = std::isfinite(rays[i].hit_m);
    result.surface_rays += hits ? 1 : 0;
    if (!std::isfinite(nearest[i])) continue;
    const bool caught = hits && is_caught(rays[i], nearest[i]);
    ++(caught ? result.caught : result.misplaced);
  }
  return result;
}

}  // namespace gloam
