// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Low-discrepancy points: M. Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018 (the R sequence),
// shifted by a hash.
#include "modules/reflections/fitting/reflected_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/core/hash.h"

namespace gloam {
namespace {

constexpr double kAspect = 16.0 / 9.0;
/// Traced positions are rounded to floats. Receivers such as puddles lie about a centimetre above the ground.
constexpr double kReceiverHeightSlack_m = 0.005;
constexpr double kLift_m = 1e-3;  ///< start of a reflected ray above its receiver

/// The R sequence in D dimensions, shifted by a hash of `stream`.
template <std::size_t D>
class PointSequence {
 public:
  explicit PointSequence(std::uint64_t stream) {
    // The root of x^(D+1) = x + 1.
    double root = 2.0;
    for (int i = 0; i < 64; ++i) root = std::pow(1.0 + root, 1.0 / (static_cast<double>(D) + 1.0));
    double step = 1.0;
    for (std::size_t d = 0; d < D; ++d) {
      step /= root;
      steps_[d] = step;
      shifts_[d] = static_cast<double>(Hasher().value(stream).value(d).digest() >> 11) * 0x1p-53;
    }
  }
  /// Coordinates in [0, 1).
  [[nodiscard]] std::array<double, D> operator[](std::uint32_t index) const {
    std::array<double, D> point{};
    for (std::size_t d = 0; d < D; ++d) {
      const double at = shifts_[d] + steps_[d] * (static_cast<double>(index) + 1.0);
      point[d] = at - std::floor(at);
    }
    return point;
  }

 private:
  std::array<double, D> steps_{};
  std::array<double, D> shifts_{};
};

/// Rays that are traced together.
struct RayBatch {
  std::vector<dvec3> origins;
  std::vector<dvec3> directions;
  std::vector<double> hits_m;
  void add(const dvec3& origin, const dvec3& direction) {
    origins.push_back(origin);
    directions.push_back(direction);
  }
  void trace(const TraceDistances& trace) {
    hits_m.assign(origins.size(), kNoHit);
    trace(origins, directions, hits_m);
  }
};

/// Looks from the eye toward the receiver, half as steeply, at most 30° down: as a walking viewer does.
RayCamera walking_camera(const dvec3& eye, const dvec3& receiver) {
  constexpr double kSteepest = 0.5236;
  const dvec3 to = receiver - eye;
  const double flat = std::sqrt(to.x * to.x + to.z * to.z);
  const double pitch = std::min(kSteepest, 0.5 * std::atan2(-to.y, flat));
  const dvec3 ahead = flat > 1e-6 ? dvec3(to.x / flat, 0.0, to.z / flat) : dvec3(0.0, 0.0, -1.0);
  const dvec3 forward = ahead * std::cos(pitch) - dvec3(0.0, std::sin(pitch), 0.0);
  const dvec3 right = glm::normalize(glm::cross(forward, dvec3(0.0, 1.0, 0.0)));
  RayCamera camera;
  camera.world_from_camera =
      dmat4(dvec4(right, 0.0), dvec4(glm::cross(right, forward), 0.0), dvec4(-forward, 0.0), dvec4(eye, 1.0));
  return camera;
}

}  // namespace

std::vector<ReflectedRay> camera_rays(std::span<const RayCamera> cameras, const UpTriangles& receivers,
                                      const RaySettings& settings, const TraceDistances& trace) {
  RayBatch views;
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    const RayCamera& camera = cameras[c];
    const double tangent = std::tan(0.5 * camera.fov_y);
    const dvec3 eye(camera.world_from_camera[3]);
    const PointSequence<2> pixels(Hasher().value(settings.sequence).value(c).digest());
    for (std::uint32_t i = 0; i < settings.pixels_a_camera; ++i) {
      const auto at = pixels[i];
      const dvec4 local((2.0 * at[0] - 1.0) * tangent * kAspect, (2.0 * at[1] - 1.0) * tangent, -1.0, 0.0);
      const dvec3 direction = glm::normalize(dvec3(camera.world_from_camera * local));
      if (direction.y < 0.0) views.add(eye, direction);
    }
  }
  views.trace(trace);
  std::vector<ReflectedRay> rays;
  RayBatch reflections;
  for (std::size_t i = 0; i < views.hits_m.size(); ++i) {
    if (!std::isfinite(views.hits_m[i])) continue;
    dvec3 point = views.origins[i] + views.directions[i] * views.hits_m[i];
    const std::optional<double> height = receivers.height_at(point, kReceiverHeightSlack_m);
    if (!height) continue;
    point.y = *height;
    const dvec3& view = views.directions[i];
    rays.push_back({.eye = views.origins[i], .receiver = point, .direction = {view.x, -view.y, view.z}});
    reflections.add(point + dvec3(0.0, kLift_m, 0.0), rays.back().direction);
  }
  reflections.trace(trace);
  for (std::size_t i = 0; i < rays.size(); ++i) rays[i].hit_m = reflections.hits_m[i];
  return rays;
}

std::vector<RayCamera> random_eyes(const UpTriangles& ground, const UpTriangles& receivers, const RaySettings& settings,
                                   const TraceDistances& trace) {
  constexpr std::uint32_t kTries = 64;
  constexpr std::uint64_t kEyeStream = ~std::uint64_t{0};  // not the number of a camera
  constexpr double kHeadroom_m = 0.2;
  std::vector<RayCamera> eyes;
  if (ground.empty() || receivers.empty()) return eyes;
  RayBatch up;
  std::vector<dvec3> targets;
  const PointSequence<6> places(Hasher().value(settings.sequence).value(kEyeStream).digest());
  for (std::uint32_t i = 0; i < settings.eyes * kTries && targets.size() < settings.eyes; ++i) {
    const auto at = places[i];
    const dvec3 feet = ground.sample(at[0], at[1], at[2]);
    const dvec3 receiver = receivers.sample(at[3], at[4], at[5]);
    if (glm::length(receiver - feet) > settings.eye_range_m || receiver.y > feet.y + settings.eye_height_m) continue;
    up.add(feet + dvec3(0.0, kLift_m, 0.0), {0.0, 1.0, 0.0});
    targets.push_back(receiver);
  }
  up.trace(trace);
  for (std::size_t i = 0; i < targets.size(); ++i)
    if (up.hits_m[i] > settings.eye_height_m + kHeadroom_m)
      eyes.push_back(walking_camera(up.origins[i] + dvec3(0.0, settings.eye_height_m, 0.0), targets[i]));
  return eyes;
}

}  // namespace gloam
