// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/governor/recent_times.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

TEST(RecentTimesTest, forgets_the_oldest) {
  RecentTimes times;
  for (int i = 0; i < 200; ++i) times.add(i);
  EXPECT_EQ(times.size(), RecentTimes::kMost);
  EXPECT_EQ(times.largest(1, RecentTimes::kMost), 199.0);
  EXPECT_EQ(times.largest(RecentTimes::kMost, RecentTimes::kMost), 140.0);
  EXPECT_EQ(times.largest(3, 3), 197.0);
  times.clear();
  EXPECT_EQ(times.size(), 0U);
}

TEST(RecentTimesTest, percentiles_are_those_of_the_sorted_times) {
  std::mt19937 random(5);
  RecentTimes times;
  std::vector<double> all;
  for (int i = 0; i < 150; ++i) {
    all.push_back(static_cast<double>(random() % 1000));
    times.add(all.back());
    for (std::size_t count = 1; count <= times.size(); ++count) {
      std::vector<double> newest(all.end() - static_cast<std::ptrdiff_t>(count), all.end());
      std::sort(newest.begin(), newest.end());
      const auto nearest_rank = static_cast<std::size_t>(std::ceil(0.9 * static_cast<double>(count) - 1e-9));
      const std::size_t rank = count > 1 ? std::min(nearest_rank, count - 1) : 1;
      ASSERT_EQ(times.percentile_90(count), newest[rank - 1]) << count;
    }
  }
}

TEST(RecentTimesTest, more_times_than_there_are_cannot_be_asked_for) {
  RecentTimes times;
  times.add(1.0);
  EXPECT_ASSERT((void)times.largest(1, 2), "as many times");
  EXPECT_ASSERT((void)times.largest(2, 1), "a rank is");
  EXPECT_ASSERT((void)times.percentile_90(0), "as many times");
}

}  // namespace
}  // namespace gloam
