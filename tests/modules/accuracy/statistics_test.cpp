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

TEST(statistics, the_interval_of_a_median_holds_the_true_median_as_often_as_it_says) {
  std::mt19937 random(11);
  std::lognormal_distribution<double> skewed(0.0, 0.3);  // median 1
  for (const std::size_t count : {8u, 40u}) {
    int held = 0;
    constexpr int kRounds = 400;
    for (int round = 0; round < kRounds; ++round) {
      std::vector<double> values(count);
      for (double& value : values) value = skewed(random);
      const Interval interval = median_interval(values);
      held += interval.low <= 1.0 && 1.0 <= interval.high ? 1 : 0;
    }
    EXPECT_GT(held, kRounds * 91 / 100) << count;
    EXPECT_LT(held, kRounds * 99 / 100) << count << ": wider than need be";
  }
}

/// Two values in a row share most of their error.
TEST(statistics, values_that_are_wrong_together_are_resampled_together) {
  std::mt19937 random(12);
  std::normal_distribution<double> shared(1.0, 0.1), own(0.0, 0.02);
  constexpr int kRounds = 400;
  int held = 0, held_alone = 0;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> values;
    for (int block = 0; block < 20; ++block) {
      const double common = shared(random);
      for (int i = 0; i < 2; ++i) values.push_back(common + own(random));
    }
    const Interval together = median_interval(values, 0.95, 2), alone = median_interval(values);
    held += together.low <= 1.0 && 1.0 <= together.high ? 1 : 0;
    held_alone += alone.low <= 1.0 && 1.0 <= alone.high ? 1 : 0;
  }
  EXPECT_GT(held, kRounds * 91 / 100);
  EXPECT_LT(held, kRounds * 99 / 100) << "wider than need be";
  EXPECT_LT(held_alone, kRounds * 90 / 100) << "the test can tell";
}

TEST(statistics, the_interval_of_a_median_is_of_the_values_alone) {
  const std::vector<double> values = {3.0, 1.0, 2.0, 5.0, 4.0};
  EXPECT_EQ(median_interval(values), median_interval(values));
  EXPECT_EQ(median_interval(std::vector<double>{7.0}), (Interval{7.0, 7.0}));
  EXPECT_EQ(median_interval(std::vector<double>(9, 2.5)), (Interval{2.5, 2.5}));
  EXPECT_EQ(median_interval(std::vector<double>(9, 2.5), 0.95, 2), (Interval{2.5, 2.5})) << "the last block is short";
}

}  // namespace
}  // namespace gloam
