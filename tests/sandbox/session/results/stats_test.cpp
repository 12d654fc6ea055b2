// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/results/stats.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gloam {
namespace {

constexpr std::uint64_t kMs = 1000000;

FrameSample frame(double ms, std::uint64_t begin_ns = 0) {
  FrameSample sample;
  sample.begin_ns = begin_ns;
  sample.end_ns = begin_ns + static_cast<std::uint64_t>(ms * 3.0) * kMs;
  sample.report.cpu_ms = ms;
  sample.report.gpu_ms = ms * 2.0;
  sample.report.passes = {{.name = "geometry", .module = "engine", .ms = ms, .dispatches = 0, .draws = 12},
                          {.name = "find_lights", .module = "lights", .ms = 1.0, .dispatches = 1, .draws = 0},
                          {.name = "find_lights", .module = "lights", .ms = 2.0, .dispatches = 2, .draws = 0}};
  sample.report.modules = {{.name = "engine", .demanded = true, .reason = "always", .pipelines = 5, .gpu_bytes = 1000},
                           {.name = "grass", .demanded = false, .reason = "no grass"}};
  sample.report.counters = {{"lights.total", 256.0}};
  sample.zones = {{.name = "transforms", .module = "engine", .begin_ns = 0, .end_ns = kMs, .thread = 0},
                  {.name = "transforms", .module = "engine", .begin_ns = kMs, .end_ns = 4 * kMs, .thread = 1}};
  return sample;
}

KnobRegistry some_knobs() {
  KnobRegistry knobs;
  knobs.add({.name = "lights.culling", .module = "lights", .choices = {"brute", "tiled"}, .default_number = 1.0});
  knobs.add({.name = "lights.slots",
             .module = "lights",
             .type = Knob::Type::integer,
             .min = 1.0,
             .max = 64.0,
             .default_number = 8.0});
  return knobs;
}

nlohmann::json stats_of(const std::vector<FrameSample>& samples) {
  const RunDescription run = {
      .scene = "builtin:plain",
      .device = {.name = "chip", .driver = "1.2", .type = gpu::DeviceType::cpu, .subgroup_size = 8},
      .width = 320,
      .height = 180};
  return nlohmann::json::parse(stats_json(run, samples, {{"nan_pixels", 0.0}}, some_knobs()));
}

TEST(Stats, hold_every_field_of_the_schema) {
  const auto stats = stats_of({frame(4.0)});
  EXPECT_EQ(stats["version"], 1);
  EXPECT_EQ(stats["scene"], "builtin:plain");
  EXPECT_EQ(stats["device"],
            nlohmann::json({{"name", "chip"}, {"driver", "1.2"}, {"type", "cpu"}, {"subgroup_size", 8}}));
  EXPECT_EQ(stats["size"], nlohmann::json({320, 180}));
  EXPECT_EQ(stats["frames"], 1);
  for (const char* clock : {"cpu", "gpu", "wall"}) {
    for (const char* field : {"median", "p10", "p90"})
      EXPECT_TRUE(stats["frame_ms"][clock][field].is_number()) << clock << field;
  }
  EXPECT_EQ(stats["memory"][0], nlohmann::json({{"module", "engine"}, {"gpu_bytes", 1000}}));
  EXPECT_EQ(stats["modules"][1],
            nlohmann::json({{"name", "grass"}, {"demanded", false}, {"reason", "no grass"}, {"pipelines", 0}}));
  EXPECT_EQ(stats["counters"], nlohmann::json({{"lights.total", 256.0}, {"nan_pixels", 0.0}}));
  EXPECT_EQ(stats["knobs"], nlohmann::json({{"lights.culling", "tiled"}, {"lights.slots", 8.0}}));
}

TEST(Stats, calls_of_one_name_in_a_frame_add_up) {
  const auto stats = stats_of({frame(4.0)});
  ASSERT_EQ(stats["passes"].size(), 2u);
  EXPECT_EQ(stats["passes"][0], nlohmann::json({{"name", "geometry"},
                                                {"module", "engine"},
                                                {"median_ms", 4.0},
                                                {"p90_ms", 4.0},
                                                {"dispatches", 0},
                                                {"draws", 12}}));
  EXPECT_EQ(stats["passes"][1]["median_ms"], 3.0);
  EXPECT_EQ(stats["passes"][1]["dispatches"], 3);
  ASSERT_EQ(stats["systems"].size(), 1u);
  EXPECT_EQ(stats["systems"][0],
            nlohmann::json(
                {{"name", "transforms"}, {"module", "engine"}, {"median_ms", 4.0}, {"p90_ms", 4.0}, {"calls", 2}}));
}

TEST(Stats, a_pass_has_a_row_for_each_view_and_other_views_are_named) {
  FrameSample sample = frame(4.0);
  sample.report.passes.push_back(sample.report.passes[0]);
  sample.report.passes.back().view = 7;
  sample.report.passes.back().ms = 1.5;
  const auto stats = stats_of({sample});
  ASSERT_EQ(stats["passes"].size(), 3u);
  EXPECT_EQ(stats["passes"][0]["median_ms"], 4.0);
  EXPECT_EQ(stats["passes"][2]["name"], stats["passes"][0]["name"]);
  EXPECT_FALSE(stats["passes"][0].contains("view"));
  EXPECT_EQ(stats["passes"][2]["view"], 7);
  EXPECT_EQ(stats["passes"][2]["median_ms"], 1.5);
}

// Hard case: program.first_frame
TEST(Stats, the_first_of_several_frames_is_left_out_of_the_times) {
  const auto stats = stats_of({frame(1000.0), frame(2.0), frame(4.0), frame(3.0)});
  EXPECT_EQ(stats["frames"], 4);
  EXPECT_DOUBLE_EQ(stats["frame_ms"]["cpu"]["median"], 3.0);
  EXPECT_DOUBLE_EQ(stats["frame_ms"]["gpu"]["median"], 6.0);
  EXPECT_DOUBLE_EQ(stats["frame_ms"]["wall"]["median"], 9.0);
  EXPECT_DOUBLE_EQ(stats["passes"][0]["median_ms"], 3.0);
  EXPECT_LT(stats["passes"][0]["p90_ms"], 5.0);
  EXPECT_EQ(stats["systems"][0]["calls"], 2);
}

TEST(Stats, a_pass_is_judged_by_the_frames_it_ran_in) {
  std::vector<FrameSample> samples = {frame(1.0), frame(1.0), frame(1.0)};
  samples[2].report.passes.push_back({.name = "shadow_map", .module = "shadows", .ms = 5.0, .draws = 3});
  const auto stats = stats_of(samples);
  EXPECT_EQ(stats["passes"][2]["median_ms"], 5.0);
  EXPECT_EQ(stats["passes"][2]["draws"], 3);
}

// Hard case: program.nan_pixels
TEST(Stats, pixels_that_are_not_numbers_are_counted_once) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<float> rgba = {0, 0, 0, 1, nan, nan, 0, 1, 1, infinity, 1, 1, 0, 0, 0, nan};
  EXPECT_EQ(count_nan_pixels(rgba), 3u) << "two with NaN, one with infinity";
}

TEST(Stats, name_the_frames_in_flight_only_if_there_are_several) {
  EXPECT_FALSE(stats_of({frame(4.0)}).contains("in_flight"));
  const RunDescription run = {.scene = "builtin:plain", .in_flight = 2};
  const auto stats = nlohmann::json::parse(stats_json(run, std::vector{frame(4.0)}, {}, some_knobs()));
  EXPECT_EQ(stats["in_flight"], 2);
}

TEST(Stats, count_overlapping_frames_from_end_to_end) {
  std::vector<FrameSample> samples(4);
  const std::uint64_t begin[] = {0, 1, 10, 60};
  const std::uint64_t end[] = {10, 25, 42, 65};
  for (std::size_t i = 0; i < 4; ++i) {
    samples[i].begin_ns = begin[i] * kMs;
    samples[i].end_ns = end[i] * kMs;
    samples[i].previous_end_ns = i == 0 ? 0 : end[i - 1] * kMs;
  }
  EXPECT_DOUBLE_EQ(samples[0].wall_ms(), 10.0);
  EXPECT_DOUBLE_EQ(samples[1].wall_ms(), 15.0) << "begun before the frame before it had ended";
  EXPECT_DOUBLE_EQ(samples[2].wall_ms(), 17.0);
  EXPECT_DOUBLE_EQ(samples[3].wall_ms(), 5.0) << "a pause between frames is in none";
}

// Hard case: passes.bytes_not_measured
TEST(Stats, hold_no_bytes_that_are_not_measured) {
  for (const auto& row : stats_of({frame(4.0)})["memory"]) EXPECT_FALSE(row.contains("cpu_bytes"));
}

}  // namespace
}  // namespace gloam
