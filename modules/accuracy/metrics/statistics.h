// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
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

/// Where a value lies with some probability.
struct Interval {
  double low = 0.0;
  double high = 0.0;
  bool operator==(const Interval&) const = default;
};

/// Interval of the median, by the bootstrap: the middle share, `probability`, of the medians of 1000 resamples. The
/// same values always give the same interval. `values`: not empty. block: each so many values in a row are drawn
/// together, because they were measured together and may be wrong together; at least 1.
[[nodiscard]] Interval median_interval(std::span<const double> values, double probability = 0.95,
                                       std::size_t block = 1);

}  // namespace gloam
