// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

namespace gloam {

/// Greatest float ≤ value; −infinity if the value is below every finite float. NaN stays NaN.
[[nodiscard]] inline float float_at_most(double value) {
  const float nearest = static_cast<float>(value);
  return nearest > value ? std::nextafter(nearest, -std::numeric_limits<float>::infinity()) : nearest;
}

/// Smallest float ≥ value; +infinity if the value is above every finite float. NaN stays NaN.
[[nodiscard]] inline float float_at_least(double value) { return -float_at_most(-value); }

}  // namespace gloam
