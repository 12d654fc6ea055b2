// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace gloam {

/// What is told of a set of measurements.
struct Summary {
  double median = 0.0;
  double p10 = 0.0;
  double p90 = 0.0;
};

/// Quantiles between neighbouring values are linear. No values: all 0.
[[nodiscard]] Summary summarize(std::vector<double> values);

}  // namespace gloam
