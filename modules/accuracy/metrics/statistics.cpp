// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/metrics/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

#include "engine/core/assert.h"

namespace gloam {

double quantile(std::vector<double>& values, double fraction) {
  GLOAM_ASSERT(!values.empty(), "a quantile is of at least one value");
  GLOAM_ASSERT(fraction >= 0.0 && fraction <= 1.0, "a quantile's fraction lies in 0…1");
  const double position = fraction * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::ptrdiff_t>(std::floor(position));
  const auto at = values.begin() + below;
  std::nth_element(values.begin(), at, values.end());
  const double weight = position - static_cast<double>(below);
  if (weight == 0.0) return *at;
  const double next = *std::min_element(at + 1, values.end());
  return *at + (next - *at) * weight;
}

Interval median_interval(std::span<const double> values, double probability, std::size_t block) {
  GLOAM_ASSERT(!values.empty(), "a median is of at least one value");
  GLOAM_ASSERT(block > 0, "a block holds at least one value");
  constexpr std::size_t kResamples = 1000;
  std::mt19937 random(1);
  const std::size_t blocks = (values.size() + block - 1) / block;
  std::vector<double> resample;
  std::vector<double> medians;
  medians.reserve(kResamples);
  for (std::size_t i = 0; i < kResamples; ++i) {
    resample.clear();
    for (std::size_t drawn = 0; drawn < blocks; ++drawn) {
      const std::size_t begin = random() % blocks * block;
      const std::size_t end = std::min(begin + block, values.size());
      resample.insert(resample.end(), values.begin() + static_cast<std::ptrdiff_t>(begin),
                      values.begin() + static_cast<std::ptrdiff_t>(end));
    }
    medians.push_back(quantile(resample, 0.5));
  }
  const double outside = 0.5 * (1.0 - probability);
  return {.low = quantile(medians, outside), .high = quantile(medians, 1.0 - outside)};
}

ErrorStatistics statistics_of(std::span<const float> errors) {
  if (errors.empty()) return {};
  std::vector<double> values(errors.begin(), errors.end());
  double sum = 0.0;
  for (const double value : values) sum += value;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  ErrorStatistics statistics = {.mean = sum / static_cast<double>(values.size()), .min = *low, .max = *high};
  statistics.p99 = quantile(values, 0.99);
  return statistics;
}

}  // namespace gloam
