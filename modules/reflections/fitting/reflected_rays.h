// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "engine/math/types.h"
#include "modules/reflections/fitting/receivers.h"

namespace gloam {

/// Distances, in metres, from origins (world) along unit directions to the nearest surface; infinity where there is
/// none. All spans have the same length.
using TraceDistances =
    std::function<void(std::span<const dvec3> origins, std::span<const dvec3> directions, std::span<double> hits_m)>;

inline constexpr double kNoHit = std::numeric_limits<double>::infinity();

/// A view ray's mirror image at a receiver with an up normal.
struct ReflectedRay {
  dvec3 eye = dvec3(0.0);                  ///< world
  dvec3 receiver = dvec3(0.0);             ///< world
  dvec3 direction = dvec3(0.0, 1.0, 0.0);  ///< unit, ascends
  double hit_m = kNoHit;                   ///< traced distance from the receiver; kNoHit: the sky
};

/// A camera that rays are sampled from. The view is 16:9.
struct RayCamera {
  dmat4 world_from_camera = dmat4(1.0);  ///< rigid; looks along −Z
  double fov_y = 0.9;                    ///< radians
};

struct RaySettings {
  std::uint32_t pixels_a_camera = 2048;
  std::uint32_t eyes = 512;  ///< placed at random
  double eye_height_m = 1.7;
  double eye_range_m = 40.0;   ///< greatest distance of an eye from the receiver that it looks at
  std::uint32_t sequence = 0;  ///< other values give other pixels and eyes
};

/// Reflected rays of the cameras' pixels that show a receiver.
[[nodiscard]] std::vector<ReflectedRay> camera_rays(std::span<const RayCamera> cameras, const UpTriangles& receivers,
                                                    const RaySettings& settings, const TraceDistances& trace);

/// Random eyes above `ground` that look toward random receivers. Eyes without headroom are left out, so there may be
/// fewer than settings.eyes. Positions follow a low-discrepancy sequence.
[[nodiscard]] std::vector<RayCamera> random_eyes(const UpTriangles& ground, const UpTriangles& receivers,
                                                 const RaySettings& settings, const TraceDistances& trace);

}  // namespace gloam
