// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/metrics/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

TEST(quantile, is_linear_between_neighbours) {
  std::vector<double> values = {40.0, 10.0, 30.0, 20.0};
  EXPECT_DOUBLE_EQ(quantile(values, 0.0), 10.0);
  EXPECT_DOUBLE_EQ(quantile(values, 0.5), 25.0);
  EXPECT_DOUBLE_EQ(quantile(values, 0.9), 37.0);
  EXPECT_DOUBLE_EQ(quantile(values, 1.0), 40.0);
}

TEST(quantile, agrees_with_sorting) {
  std::mt19937 random(1);
  for (std::size_t count = 1; count < 60; ++count) {
    std::vector<double> values(count);
    for (double& value : values) value = static_cast<double>(random() % 20);
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const double position = 0.37 * static_cast<double>(count - 1);
    const auto below = static_cast<std::size_t>(position);
    const double above = sorted[std::min(below + 1, count - 1)];
    EXPECT_NEAR(quantile(values, 0.37),
                sorted[below] + (above - sorted[below]) * (position - static_cast<double>(below)), 1e-12);
  }
}

TEST(quantile, needs_a_value_and_a_fraction) {
  std::vector<double> none;
  std::vector<double> one = {1.0};
  EXPECT_ASSERT((void)quantile(none, 0.5), "at least one value");
  EXPECT_ASSERT((void)quantile(one, 1.5), "0…1");
}

TEST(statistics, of_an_empty_map_are_nothing) {
  EXPECT_EQ(statistics_of({}).mean, 0.0);
  EXPECT_EQ(statistics_of({}).p99, 0.0);
}

TEST(statistics, tell_mean_percentile_and_ends) {
  std::vector<float> values;
  for (int i = 100; i >= 0; --i) values.push_back(static_cast<float>(i));
  const ErrorStatistics statistics = statistics_of(values);
  EXPECT_DOUBLE_EQ(statistics.mean, 50.0);
  EXPECT_DOUBLE_EQ(statistics.p99, 99.0);
  EXPECT_DOUBLE_EQ(statistics.min, 0.0);
  EXPECT_DOUBLE_EQ(statistics.max, 100.0);
}

}  // namespace
}  // namespace gloam
