// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace gloam {

/// Median, 10th and 90th percentile of a set of measurements.
struct Summary {
  double median = 0.0;
  double p10 = 0.0;
  double p90 = 0.0;
};

/// Percentiles are interpolated linearly between neighbouring values. Without values all are 0.
[[nodiscard]] Summary summarize(std::vector<double> values);

}  // namespace gloam
