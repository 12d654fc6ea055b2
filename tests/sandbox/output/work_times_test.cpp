// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/work_times.h"

#include <gtest/gtest.h>

#include <set>

namespace gloam {
namespace {

TEST(WorkTimes, add_up_the_times_of_each_kind_and_name_the_longest_first) {
  WorkTimes::Clock::time_point now;
  WorkTimes times([&now] { return now; });
  const auto work = [&](CostPhase phase, std::chrono::milliseconds time) {
    times.begin(phase);
    now += time;
  };
  using std::chrono::operator""ms;
  work(CostPhase::pictures, 2000ms);
  work(CostPhase::timing, 3000ms);
  work(CostPhase::memory, 400ms);
  work(CostPhase::pictures, 2600ms);
  EXPECT_EQ(times.text(), "measuring took 8 s: pictures 5 s, timing 3 s\n");
}

TEST(WorkTimes, have_a_name_for_each_kind) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kCostPhases; ++i) names.insert(name_of(static_cast<CostPhase>(i)));
  EXPECT_EQ(names.size(), kCostPhases);
  EXPECT_FALSE(names.contains(""));
}

}  // namespace
}  // namespace gloam
