// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/timing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

/// A fake machine whose clock advances only when it draws: 10 ms for the default A, 20 for the candidate B, 30 for C.
class FakeMachine {
 public:
  /// Each frame takes `drift_ms` longer than the one before. The first frame after a change of side takes 1000 ms more.
  explicit FakeMachine(double drift_ms = 0.0) : drift_ms_(drift_ms) {}

  RunFrame runner() {
    return [this](TimedSide side) -> Result<FrameCost> {
      const double start = now_ms_;
      const char name = "ABC"[side];
      now_ms_ += 10.0 * static_cast<double>(side + 1);
      now_ms_ += drift_ms_ * static_cast<double>(sides_.size());
      if (sides_.empty() || sides_.back() != name) now_ms_ += 1000.0;
      sides_ += name;
      const double gpu_ms = (now_ms_ - start) * 0.75;
      return FrameCost{.cpu_ms = gpu_ms / 3.0, .gpu_ms = gpu_ms};
    };
  }
  [[nodiscard]] const std::string& sides() const { return sides_; }

 private:
  double drift_ms_;
  double now_ms_ = 0.0;
  std::string sides_;
};

/// Of one candidate.
AlternatingTimes time_one(const TimingPlan& plan, const RunFrame& run) {
  auto times = time_alternating(plan, 1, run);
  EXPECT_TRUE(times.ok());
  EXPECT_EQ(times->size(), 1u);
  return std::move(times->front());
}

TEST(timing, alternates_and_leaves_warm_up_out) {
  FakeMachine machine;
  const AlternatingTimes times = time_one({.most_pairs = 5}, machine.runner());
  EXPECT_EQ(machine.sides(),
            "BBBAAA"
            "AABBB"
            "BAA");
  ASSERT_EQ(times.standard.size(), 5u);
  ASSERT_EQ(times.candidate.size(), 5u);
  for (const FrameCost& cost : times.standard) EXPECT_DOUBLE_EQ(cost.ms(), 10.0);
  for (const FrameCost& cost : times.candidate) EXPECT_DOUBLE_EQ(cost.ms(), 20.0);
}

TEST(timing, two_candidates_are_measured_on_both_sides_of_the_default) {
  FakeMachine machine;
  const auto times = time_alternating({.most_pairs = 5}, 2, machine.runner());
  ASSERT_TRUE(times.ok());
  EXPECT_EQ(machine.sides(),
            "BBBAAACCC"
            "CCAAABBB"
            "BAACC");
  ASSERT_EQ(times->size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ((*times)[i].standard.size(), 5u);
    ASSERT_EQ((*times)[i].candidate.size(), 5u);
    for (const FrameCost& cost : (*times)[i].standard) EXPECT_DOUBLE_EQ(cost.ms(), 10.0);
    for (const FrameCost& cost : (*times)[i].candidate) EXPECT_DOUBLE_EQ(cost.ms(), i == 0 ? 20.0 : 30.0);
  }
}

TEST(timing, a_candidate_that_is_known_leaves_the_other_alone) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::string sides;
  const RunFrame run = [&](TimedSide side) -> Result<FrameCost> {
    sides += "ABC"[side];
    const double noise = side == 2 ? 0.5 * normal(random) : 0.0;
    return FrameCost{.gpu_ms = 10.0 * std::exp(noise)};
  };
  const auto times = time_alternating({.most_pairs = 10}, 2, run);
  ASSERT_TRUE(times.ok());
  EXPECT_EQ((*times)[0].candidate.size(), 6u);
  EXPECT_EQ((*times)[0].standard.size(), 6u) << "only those beside its own";
  EXPECT_EQ((*times)[1].candidate.size(), 10u);
  EXPECT_EQ((*times)[1].standard.size(), 10u);
  EXPECT_EQ(sides,
            "BBBAAACCC"
            "CCAAABBB"
            "BBAAACCC"
            "CCAAA"
            "AACCC");
}

/// Runs of two equal sides whose frames take 10 ms, times exp(noise · a normal number).
RunFrame noisy(double noise, std::mt19937& random) {
  return [noise, &random](TimedSide) -> Result<FrameCost> {
    std::normal_distribution<double> normal;
    return FrameCost{.gpu_ms = 10.0 * std::exp(noise * normal(random))};
  };
}

TEST(timing, measures_until_the_ratio_is_known_well_enough) {
  std::mt19937 random(3);
  const auto pairs = [&](double noise, double wanted) {
    return time_one({.most_pairs = 200, .wanted = wanted}, noisy(noise, random)).candidate.size();
  };
  EXPECT_EQ(pairs(0.0, 0.02), 6u) << "the fewest";
  EXPECT_EQ(pairs(0.5, 0.02), 200u) << "the most";
  const std::size_t some = pairs(0.05, 0.02);
  EXPECT_GT(some, 16u);
  EXPECT_LT(some, 200u);
  EXPECT_LT(pairs(0.05, 0.06), some);
}

TEST(timing, ends_with_six_pairs_when_the_time_is_spent) {
  std::mt19937 random(3);
  int asked = 0;
  TimingPlan plan = {.most_pairs = 200, .wanted = 0.02};
  plan.out_of_time = [&] { return ++asked > 3; };
  EXPECT_EQ(time_one(plan, noisy(0.5, random)).candidate.size(), 12u);
  plan.out_of_time = [] { return true; };
  EXPECT_EQ(time_one(plan, noisy(0.5, random)).candidate.size(), 6u);
}

TEST(timing, the_interval_of_few_pairs_is_their_range) {
  AlternatingTimes times;
  for (int i = 0; i < 6; ++i) {
    times.standard.push_back({.gpu_ms = 10.0});
    times.candidate.push_back({.gpu_ms = 10.0 + i});
  }
  EXPECT_EQ(summarize_times(times).ratio_interval, (Interval{1.0, 1.5}));
  const Interval sure = summarize_times(times).sure_interval;
  EXPECT_DOUBLE_EQ(sure.low, 0.5) << "six pairs are never sure to 99.8 %: the range and its length on both sides";
  EXPECT_DOUBLE_EQ(sure.high, 2.0);
  for (int i = 0; i < 4; ++i) {
    times.standard.push_back({.gpu_ms = 10.0});
    times.candidate.push_back({.gpu_ms = 12.0});
  }
  EXPECT_EQ(summarize_times(times).sure_interval, (Interval{1.0, 1.5})) << "ten are";
}

TEST(timing, few_pairs_rarely_miss_the_ratio) {
  std::mt19937 random(5);
  int apart = 0, surely_apart = 0;
  std::size_t pairs = 0;
  constexpr int kRounds = 400;
  for (int round = 0; round < kRounds; ++round) {
    const AlternatingTimes times = time_one({.most_pairs = 40, .wanted = 0.06}, noisy(0.02, random));
    pairs += times.candidate.size();
    const TimedValue timed = summarize_times(times);
    apart += timed.ratio_interval.low > 1.0 || timed.ratio_interval.high < 1.0 ? 1 : 0;
    surely_apart += timed.sure_interval.low > 1.0 || timed.sure_interval.high < 1.0 ? 1 : 0;
  }
  EXPECT_LT(pairs, 9u * kRounds) << "a quiet machine needs few";
  EXPECT_LE(apart, 32) << "5 % of 95 % intervals are 20; stopping at the first narrow one adds some";
  EXPECT_LE(surely_apart, 3);
}

TEST(timing, equal_sides_are_apart_hardly_ever) {
  std::mt19937 random(4);
  int apart = 0, surely_apart = 0;
  constexpr int kRounds = 200;
  for (int round = 0; round < kRounds; ++round) {
    const AlternatingTimes times = time_one({.most_pairs = 40, .wanted = 0.06}, noisy(0.1, random));
    const Interval interval = summarize_times(times).ratio_interval;
    apart += interval.low > 1.0 || interval.high < 1.0 ? 1 : 0;
    const Interval sure = summarize_times(times).sure_interval;
    surely_apart += sure.low > 1.0 || sure.high < 1.0 ? 1 : 0;
  }
  // 5 % of 95 % intervals; stopping at the first narrow one adds some.
  EXPECT_LE(apart, 24);
  EXPECT_LE(surely_apart, 2);
}

TEST(timing, a_busy_machine_does_not_change_processor_time) {
  AlternatingTimes times;
  for (int i = 0; i < 8; ++i) {
    times.standard.push_back({.cpu_ms = 1.0, .gpu_ms = 4.0 * (1 + i % 3), .processor_ms = 4.0});
    times.candidate.push_back({.cpu_ms = 1.0, .gpu_ms = 9.0 * (1 + i % 2), .processor_ms = 6.0});
  }
  const TimedValue timed = summarize_times(times);
  EXPECT_DOUBLE_EQ(timed.ratio, 1.5);
  EXPECT_EQ(timed.ratio_interval, (Interval{1.5, 1.5}));
  EXPECT_DOUBLE_EQ(timed.ms.median_ms, 6.0);
  EXPECT_DOUBLE_EQ(timed.wall_ms, 14.5) << "beside it";
}

TEST(timing, tells_median_spread_and_ratio) {
  FakeMachine machine;
  const TimedValue timed = summarize_times(time_one({}, machine.runner()));
  EXPECT_DOUBLE_EQ(timed.ms.median_ms, 20.0);
  EXPECT_DOUBLE_EQ(timed.ms.p10_ms, 20.0);
  EXPECT_DOUBLE_EQ(timed.ms.p90_ms, 20.0);
  EXPECT_DOUBLE_EQ(timed.cpu_ms, 5.0);
  EXPECT_DOUBLE_EQ(timed.gpu_ms, 15.0);
  EXPECT_DOUBLE_EQ(timed.ratio, 2.0);
  EXPECT_EQ(timed.ratio_interval, (Interval{2.0, 2.0}));
}

TEST(timing, a_machine_that_slows_down_hardly_moves_the_ratio) {
  FakeMachine drifting(0.07);
  const TimedValue timed = summarize_times(time_one({.most_pairs = 20, .wanted = 0.0}, drifting.runner()));
  EXPECT_GT(timed.ms.p90_ms, timed.ms.p10_ms + 2.0);
  // The ratio at the middle frame of the run. Timing one side after the other would give more than 2.
  const double middle = 0.07 * 26.0;
  EXPECT_NEAR(timed.ratio, (20.0 + middle) / (10.0 + middle), 0.05);
}

TEST(timing, one_interrupted_frame_does_not_move_the_median) {
  AlternatingTimes times;
  for (int i = 0; i < 9; ++i) {
    times.standard.push_back({.gpu_ms = 4.0});
    times.candidate.push_back({.gpu_ms = i == 5 ? 500.0 : 2.0});
  }
  const TimedValue timed = summarize_times(times);
  EXPECT_DOUBLE_EQ(timed.ms.median_ms, 2.0);
  EXPECT_DOUBLE_EQ(timed.ratio, 0.5);
}

TEST(timing, pairs_without_a_time_say_nothing_of_the_ratio) {
  AlternatingTimes times;
  times.standard = {{.gpu_ms = 0.0}, {.gpu_ms = 2.0}};
  times.candidate = {{.gpu_ms = 5.0}, {.gpu_ms = 6.0}};
  EXPECT_DOUBLE_EQ(summarize_times(times).ratio, 3.0);
  times.standard[1].gpu_ms = 0.0;
  EXPECT_DOUBLE_EQ(summarize_times(times).ratio, 1.0);
}

TEST(timing, stops_at_the_first_frame_that_fails) {
  int frames = 0;
  const auto times = time_alternating({}, 1, [&frames](TimedSide) -> Result<FrameCost> {
    if (++frames == 9) return Error{ErrorKind::failed, "the device is lost"};
    return FrameCost{};
  });
  ASSERT_FALSE(times.ok());
  EXPECT_EQ(times.error().message, "the device is lost");
  EXPECT_EQ(frames, 9);
}

TEST(timing, needs_a_frame) {
  FakeMachine machine;
  EXPECT_ASSERT((void)time_alternating({.most_pairs = 0}, 1, machine.runner()), "at least one frame");
  EXPECT_ASSERT((void)time_alternating({}, 3, machine.runner()), "on one side or on both");
  EXPECT_ASSERT((void)summarize_times({}), "at least one frame");
}

}  // namespace
}  // namespace gloam
