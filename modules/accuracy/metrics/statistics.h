// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

namespace gloam {

/// Summary of an error map. All 0 for an empty one.
struct ErrorStatistics {
  double mean = 0.0;
  double p99 = 0.0;  ///< 99th percentile
  double min = 0.0;
  double max = 0.0;
};

[[nodiscard]] ErrorStatistics statistics_of(std::span<const float> errors);

/// The value below which a fraction (0…1) of the values lies, linear between neighbours. `values`: not empty; gets
/// reordered.
[[nodiscard]] double quantile(std::vector<double>& values, double fraction);

}  // namespace gloam
