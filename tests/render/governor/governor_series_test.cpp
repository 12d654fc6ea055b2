// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/render/governor/machine.h"
#include "tests/render/governor/recorded_series.h"

// Made-up and recorded series. Each test states its bounds, and records the figures it found.

namespace gloam {
namespace {

using test::best_fixed_point;
using test::draw;
using test::Drive;
using test::Figures;
using test::figures_of;
using test::geometric_front;
using test::Machine;
using test::machine_of;
using test::Noise;

constexpr std::size_t kPoints = 16;
constexpr double kGrowth = 1.15;
/// Frames before a step of load. Until then the governor has settled.
constexpr std::size_t kBefore = 600;
constexpr std::size_t kFrames = 1800;

/// A front and a machine where point 8 takes 0.874 of the budget at load 1.
std::vector<GovernorPoint> front_for(double budget_ms) { return geometric_front(kPoints, budget_ms / 3.5, kGrowth); }

struct NoiseLevel {
  Noise kind = Noise::uniform;
  double level = 0.0;
};
const NoiseLevel kNoises[] = {{Noise::uniform, 0.0},
                              {Noise::uniform, 0.05},
                              {Noise::uniform, 0.1},
                              {Noise::gaussian, 0.05},
                              {Noise::gaussian, 0.1}};
const double kFramesPerSecond[] = {15.0, 30.0, 60.0};

using Load = std::function<double(std::size_t frame, std::size_t point)>;

/// The worst figures over rates of 15 to 60 frames a second, noises and seeds.
struct Worst {
  double changes_per_second = 0.0;
  double settle_seconds = 0.0;
  std::size_t settle_frames = 0;
  std::size_t longest_over = 0;
  double over_share = 0.0;
  double p90_of_budget = 0.0;
  std::size_t points_too_low = 0;  ///< the cheapest point used, below the best that fits with 10 % to spare
  double error_of_best = 0.0;      ///< mean error, divided by that of the best fixed point
  double error_of_best_fit = 0.0;  ///< the same against the best point that fits with 10 % to spare
  std::size_t distance = 0;        ///< points between the last one and the best that fits with 10 % to spare

  void record(const std::string& name) const {
    const auto put = [&](const char* figure, auto value) {
      ::testing::Test::RecordProperty(name + "." + figure, std::to_string(value));
    };
    put("changes_per_second", changes_per_second);
    put("settle_seconds", settle_seconds);
    put("settle_frames", settle_frames);
    put("longest_over", longest_over);
    put("over_share", over_share);
    put("p90_of_budget", p90_of_budget);
    put("points_too_low", points_too_low);
    put("error_of_best", error_of_best);
    put("error_of_best_fit", error_of_best_fit);
    put("distance", distance);
  }
};

/// Figures of the frames from `begin` on. Rest: the frames from 400 on after `begin`.
Worst worst_of(const Load& load, std::size_t begin = kBefore, std::size_t frames = kFrames) {
  Worst worst;
  for (const double rate : kFramesPerSecond) {
    for (const NoiseLevel& noise : kNoises) {
      for (std::uint32_t seed = 1; seed <= 5; ++seed) {
        const double budget = 1000.0 / rate;
        const std::vector<GovernorPoint> front = front_for(budget);
        Machine machine = machine_of(front);
        machine.load = load;
        machine.kind = noise.kind;
        machine.noise = noise.level;
        machine.seed = seed;
        Governor governor(front, budget);
        const Drive drive = draw(governor, machine, frames);
        const std::span<const test::DrawnFrame> all(drive);
        const Figures step = figures_of(all.subspan(begin), front);
        const Figures rest = figures_of(all.subspan(begin + 400), front);
        const std::size_t best = best_fixed_point(machine, begin + 400, frames, budget);
        const std::size_t best_fit = best_fixed_point(machine, begin + 400, frames, Governor::kFit * budget);
        const auto most = [](auto& to, auto value) { to = std::max(to, value); };
        most(worst.changes_per_second, static_cast<double>(rest.changes) / rest.seconds);
        most(worst.settle_seconds, step.settle_seconds);
        most(worst.settle_frames, step.settle_frames);
        most(worst.longest_over, step.longest_over);
        most(worst.over_share, step.over_share);
        most(worst.p90_of_budget, rest.p90_of_budget);
        most(worst.points_too_low, best_fit - std::min(best_fit, step.lowest));
        most(worst.error_of_best, rest.mean_error / front[best].error);
        most(worst.error_of_best_fit, rest.mean_error / front[best_fit].error);
        most(worst.distance, best_fit > rest.last ? best_fit - rest.last : rest.last - best_fit);
      }
    }
  }
  return worst;
}

/// A load that is 1 and then another one.
Load step_to(double load) {
  return [=](std::size_t frame, std::size_t) { return frame < kBefore ? 1.0 : load; };
}

/// What holds at rest, whatever came before.
void expect_rest(const Worst& worst) {
  EXPECT_LE(worst.changes_per_second, 1.0);
  EXPECT_LE(worst.p90_of_budget, 1.1);
  EXPECT_LE(worst.distance, 1U);
  // The best point that fits with 10 % to spare, or its neighbour, whose error is 1.25 times as much.
  EXPECT_LE(worst.error_of_best_fit, 1.25);
  // Against the best point that fits at all: one more neighbour, because of the room that is spared.
  EXPECT_LE(worst.error_of_best, 1.25 * 1.25);
}

TEST(GovernorSeriesTest, noise_does_not_make_it_oscillate) {
  const Worst worst = worst_of(step_to(1.0));
  worst.record("noise");
  expect_rest(worst);
  EXPECT_LE(worst.changes_per_second, 0.5);
  EXPECT_LE(worst.over_share, 0.05);
}

TEST(GovernorSeriesTest, a_step_of_load_is_followed_within_two_seconds) {
  for (const double load : {0.25, 0.5, 0.8, 1.3, 2.0, 3.0}) {
    SCOPED_TRACE(load);
    const Worst worst = worst_of(step_to(load));
    worst.record("load_" + std::to_string(load).substr(0, 4));
    expect_rest(worst);
    EXPECT_LE(worst.settle_seconds, 2.0);
    // Four frames to notice, two that are not judged, and once more if noise has hidden a part of the step.
    EXPECT_LE(worst.longest_over, 12U);
    if (load > 1.0) {
      EXPECT_LE(worst.points_too_low, 1U);
    }
  }
}

TEST(GovernorSeriesTest, a_machine_that_becomes_slow_and_fast_again_is_followed) {
  const Worst worst =
      worst_of([](std::size_t frame, std::size_t) { return frame < 300 || frame >= kBefore ? 1.0 : 2.0; });
  worst.record("slow_and_fast_again");
  expect_rest(worst);
  EXPECT_LE(worst.settle_seconds, 2.0);
}

TEST(GovernorSeriesTest, a_slow_drift_is_followed) {
  for (const double end : {2.0, 0.5}) {
    SCOPED_TRACE(end);
    const Worst worst = worst_of([=](std::size_t frame, std::size_t) {
      return std::pow(end, std::clamp((static_cast<double>(frame) - kBefore) / 1000.0, 0.0, 1.0));
    });
    worst.record(end > 1.0 ? "drift_up" : "drift_down");
    EXPECT_LE(worst.p90_of_budget, 1.1);
    // During the drift one frame in ten may be over before it steps, and there are six steps or less.
    EXPECT_LE(worst.over_share, 0.15);
    EXPECT_LE(worst.longest_over, 4U);
    EXPECT_LE(worst.changes_per_second, 1.0);
  }
}

TEST(GovernorSeriesTest, a_path_into_a_room_where_exact_points_grow_more_is_followed) {
  const Load load = [](std::size_t frame, std::size_t point) {
    return frame < kBefore ? 1.0 : 1.3 * std::pow(1.08, static_cast<double>(point));
  };
  const Worst worst = worst_of(load);
  worst.record("heavier_room");
  expect_rest(worst);
  // It goes too low, because the load of cheap points is not known before it is measured, and comes back.
  EXPECT_LE(worst.points_too_low, 4U);
  EXPECT_LE(worst.settle_seconds, 4.0);
  EXPECT_LE(worst.longest_over, 12U);
}

TEST(GovernorSeriesTest, effects_that_come_and_go_do_not_make_it_oscillate) {
  // Every 90 frames the points from 5 on become equal in time, or differ again.
  const Load load = [](std::size_t frame, std::size_t point) {
    return frame / 90 % 2 == 0 ? 1.0 : std::min(1.0, std::pow(kGrowth, 5.0 - static_cast<double>(point)));
  };
  const Worst worst = worst_of(load, 0, 6000);
  worst.record("come_and_go");
  EXPECT_LE(worst.changes_per_second, 0.6);
  EXPECT_LE(worst.over_share, 0.15);
  // They are followed where a step holds for two seconds before they come back, which is two to four changes in 12 s at
  // 15 frames a second. At 60 frames a second it does not hold: the time before the next try doubles.
  const Worst later = worst_of(load, 4000, 6000);
  later.record("come_and_go_later");
  EXPECT_LE(later.changes_per_second, 0.6);
}

TEST(GovernorSeriesTest, a_short_burst_of_load_is_forgotten) {
  const Worst worst =
      worst_of([](std::size_t frame, std::size_t) { return frame < kBefore || frame >= kBefore + 15 ? 1.0 : 2.5; });
  worst.record("burst");
  expect_rest(worst);
  EXPECT_LE(worst.settle_seconds, 4.0);
}

TEST(GovernorSeriesTest, rare_spikes_change_nothing) {
  // 2 % of the frames take ten times as long.
  test::NoiseSource spikes(3, Noise::uniform, 0.15);
  std::vector<bool> is_spike;
  for (std::size_t i = 0; i < 20000; ++i) is_spike.push_back(spikes.next() < 0.85 + 0.02 * 0.3);
  const std::vector<GovernorPoint> front = front_for(33.3);
  Machine machine = machine_of(front);
  machine.noise = 0.05;
  machine.load = [&](std::size_t frame, std::size_t) { return is_spike[frame] ? 10.0 : 0.95; };
  Governor governor(front, 33.3);
  const Figures figures = figures_of(draw(governor, machine, is_spike.size()), front);
  RecordProperty("changes", std::to_string(figures.changes));
  EXPECT_LE(figures.changes, 4U);
  EXPECT_EQ(figures.last, 8U);
}

TEST(GovernorSeriesTest, recorded_series_are_read) {
  const std::vector<std::vector<double>> series = test::parse_series("1 2.5 3\n\n  4 5 6.25 \n7 8 9");
  EXPECT_EQ(series, (std::vector<std::vector<double>>{{1.0, 2.5, 3.0}, {4.0, 5.0, 6.25}, {7.0, 8.0, 9.0}}));
  for (const std::string_view text : {test::kRecordedLanterns, test::kRecordedWetStreet}) {
    const std::vector<std::vector<double>> recorded = test::parse_series(text);
    EXPECT_EQ(recorded.size(), 120U);
    for (const std::vector<double>& frame : recorded) EXPECT_EQ(frame.size(), 6U);
  }
}

/// The front that a ledger would have of a recorded series: medians of its columns.
std::vector<GovernorPoint> front_of_series(std::string_view text) {
  const std::vector<std::vector<double>> series = test::parse_series(text);
  std::vector<GovernorPoint> front;
  for (std::size_t point = 0; point < series.front().size(); ++point) {
    std::vector<double> column;
    for (std::size_t frame = 1; frame < series.size(); ++frame) column.push_back(series[frame][point]);
    std::sort(column.begin(), column.end());
    front.push_back({column[column.size() / 2], 0.2 * std::pow(0.6, static_cast<double>(point))});
  }
  return front;
}

TEST(GovernorSeriesTest, recorded_series_stay_within_the_budget) {
  const std::vector<GovernorPoint> front = front_of_series(test::kRecordedWetStreet);
  for (const std::string_view text : {test::kRecordedWetStreet, test::kRecordedLanterns}) {
    const bool street = text == test::kRecordedWetStreet;
    for (const double budget : {30.0, 40.0, 50.0, 66.7, 90.0, 120.0}) {
      SCOPED_TRACE(std::string(street ? "street " : "lanterns ") + std::to_string(budget));
      const Machine machine = test::recorded_machine(text, 1);
      Governor governor(front, budget);  // lanterns: the front is of another scene
      const Drive drive = draw(governor, machine, 1190);
      const Figures rest = figures_of(std::span(drive).subspan(238), front);
      const std::size_t best = best_fixed_point(machine, 0, 119, budget);
      const std::string name = (street ? "street_" : "lanterns_") + std::to_string(static_cast<int>(budget));
      RecordProperty(name + ".p90_of_budget", std::to_string(rest.p90_of_budget));
      RecordProperty(name + ".over_share", std::to_string(rest.over_share));
      RecordProperty(name + ".changes", std::to_string(rest.changes));
      RecordProperty(name + ".seconds", std::to_string(rest.seconds));
      RecordProperty(name + ".error_of_best", std::to_string(rest.mean_error / front[best].error));
      EXPECT_LE(static_cast<double>(rest.changes), rest.seconds);
      if (test::fixed_percentile_90(machine, 0, 119, best) <= budget) {
        EXPECT_LE(rest.p90_of_budget, 1.1);
      }
    }
  }
}

TEST(GovernorSeriesTest, a_front_of_a_slower_or_faster_machine_leads_to_the_same_point_of_a_recorded_series) {
  const Machine machine = test::recorded_machine(test::kRecordedWetStreet, 1);
  for (const double speed : {0.2, 0.5, 2.0, 5.0}) {
    std::vector<GovernorPoint> front = front_of_series(test::kRecordedWetStreet);
    for (GovernorPoint& point : front) point.ms *= speed;
    Governor governor(front, 40.0);
    const Figures figures = figures_of(draw(governor, machine, 1190), front);
    RecordProperty("speed_" + std::to_string(speed) + ".changes", std::to_string(figures.changes));
    RecordProperty("speed_" + std::to_string(speed) + ".settle_seconds", std::to_string(figures.settle_seconds));
    EXPECT_EQ(figures.last, 3U) << speed;
    EXPECT_LE(figures.changes, 3U) << speed;
    EXPECT_LE(figures.settle_seconds, 2.0) << speed;
  }
}

TEST(GovernorSeriesTest, a_recorded_change_of_scene_is_followed) {
  const std::vector<GovernorPoint> front = front_of_series(test::kRecordedWetStreet);
  const Machine street = test::recorded_machine(test::kRecordedWetStreet, 1);
  const Machine lanterns = test::recorded_machine(test::kRecordedLanterns, 1);
  Machine both = street;
  both.load = [&](std::size_t frame, std::size_t point) {
    return frame / 357 % 2 == 0 ? street.load(frame, point) : lanterns.load(frame, point);
  };
  both.view = [](std::size_t frame) { return frame / 357; };
  Governor governor(front, 66.7);
  const Drive drive = draw(governor, both, 4 * 357);
  const Figures figures = figures_of(drive, front);
  RecordProperty("p90_of_budget", std::to_string(figures.p90_of_budget));
  RecordProperty("over_share", std::to_string(figures.over_share));
  RecordProperty("changes", std::to_string(figures.changes));
  RecordProperty("longest_over", std::to_string(figures.longest_over));
  EXPECT_LE(figures.p90_of_budget, 1.1);
  EXPECT_LE(figures.longest_over, 24U);
  EXPECT_LE(figures.changes, 20U);
}

}  // namespace
}  // namespace gloam
