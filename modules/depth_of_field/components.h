// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace gloam {

/// Shape of the aperture. A hexagon has a corner at the top and the same radius as the disc, from corner to centre.
enum class Bokeh : std::uint8_t { round, hexagonal };

/// Depth of field of the entity's camera; on when focus_m > 0. The focus may be infinite. Any f-number is allowed: less
/// than kLeastFNumber counts as that, and an infinite one blurs nothing.
struct DepthOfField {
  float focus_m = 0.0f;
  float f_number = 2.8f;
  Bokeh bokeh = Bokeh::round;
  float metres_per_unit = 1.0f;  ///< of focus_m: what the sensor's height is compared with; > 0
};

inline constexpr float kLeastFNumber = 0.01f;

}  // namespace gloam
