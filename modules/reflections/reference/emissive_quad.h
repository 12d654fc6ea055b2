// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/math/types.h"

namespace gloam {

/// A flat image that only reflected rays see, from its front (half_u × half_v), e.g. a fire.
struct EmissiveQuad {
  dvec3 center = dvec3(0.0);            ///< world
  dvec3 half_u = dvec3(1.0, 0.0, 0.0);  ///< from the middle to the right edge, metres
  dvec3 half_v = dvec3(0.0, 1.0, 0.0);  ///< from the middle to the upper edge, at a right angle to half_u
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::span<const vec4> rgba;  ///< linear, premultiplied by alpha; rows from the top. Must outlive the trace
  float radiance = 1.0f;       ///< cd/m² of value 1
  float opacity = 1.0f;        ///< factor of alpha
};

/// The part of a quad that a ray meets.
struct QuadLayer {
  double distance_m = std::numeric_limits<double>::infinity();
  dvec3 radiance = dvec3(0.0);  ///< premultiplied by alpha
  double alpha = 0.0;
};

/// Appends the layers that a ray meets before to_m, nearest first. layers: emptied. origin: world; direction: unit.
void find_layers(std::span<const EmissiveQuad> quads, const dvec3& origin, const dvec3& direction, double to_m,
                 std::vector<QuadLayer>& layers);

}  // namespace gloam
