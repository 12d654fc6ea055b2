// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace gloam {

enum class Bokeh : std::uint8_t { round, hexagonal };

/// Depth of field of the entity's camera; on when focus_m > 0.
struct DepthOfField {
  float focus_m = 0.0f;
  float f_number = 2.8f;
  Bokeh bokeh = Bokeh::round;
};

}  // namespace gloam
