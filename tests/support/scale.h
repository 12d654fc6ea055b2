// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/core/env.h"

namespace gloam::test {

/// `count` times the environment variable GLOAM_TEST_SCALE (1 when absent or not a positive number), rounded; at least
/// 1.
[[nodiscard]] inline int scaled(int count) {
  const double scale = environment_number("GLOAM_TEST_SCALE").value_or(1.0);
  if (!(scale > 0.0) || !std::isfinite(scale)) return std::max(count, 1);
  return static_cast<int>(std::clamp(std::round(count * scale), 1.0, 1e9));
}

}  // namespace gloam::test
