// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/trace.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace gloam {
namespace {

constexpr std::uint64_t kGpuStart = (std::uint64_t{1} << 62) + 1;  // a double has no room for its nanoseconds

PassTime pass(const char* name, std::uint64_t begin_ns, std::uint64_t end_ns) {
  PassTime time{.name = name, .module = "engine"};
  time.begin_ns = kGpuStart + begin_ns;
  time.end_ns = kGpuStart + end_ns;
  return time;
}

/// Begin and end of the events on the GPU's row, in microseconds.
std::vector<std::pair<double, double>> gpu_row(const std::vector<FrameSample>& samples) {
  const auto trace = nlohmann::json::parse(chrome_trace(samples));
  std::vector<std::pair<double, double>> row;
  int gpu = -1;
  for (const auto& event : trace["traceEvents"])
    if (event["ph"] == "M" && event["args"]["name"] == "GPU") gpu = event["tid"];
  for (const auto& event : trace["traceEvents"])
    if (event["ph"] == "X" && event["tid"] == gpu) {
      const double begin = event["ts"];
      row.emplace_back(begin, begin + event["dur"].get<double>());
    }
  return row;
}

/// A frame of two passes with a gap between them. Times: nanoseconds of the CPU's clock, but GPU times of the GPU's.
FrameSample frame(std::uint64_t submitted, std::uint64_t gpu_begin, std::uint64_t end) {
  FrameSample sample;
  sample.begin_ns = submitted - 500;
  sample.report.submitted_ns = submitted;
  sample.end_ns = end;
  sample.report.passes = {pass("a", gpu_begin, gpu_begin + 1000), pass("b", gpu_begin + 1300, gpu_begin + 3000)};
  return sample;
}

TEST(Trace, places_the_gpus_clock_so_that_no_frame_begins_before_its_submission) {
  // The GPU's clock is 100 µs behind the CPU's. Frames begin 700, 40 and 9000 ns after their submission.
  const std::vector<FrameSample> samples = {frame(110'000, 10'700, 120'000), frame(130'000, 30'040, 140'000),
                                            frame(131'000, 40'000, 150'000)};
  const auto row = gpu_row(samples);
  ASSERT_EQ(row.size(), 6u);
  EXPECT_NEAR(row[0].first, 110.66, 1e-6) << "the shortest delay, 40 ns, is taken for none";
  EXPECT_NEAR(row[0].second, 111.66, 1e-6);
  EXPECT_NEAR(row[1].first, 111.96, 1e-6);
  EXPECT_NEAR(row[2].first, 130.0, 1e-6);
  EXPECT_NEAR(row[4].first, 139.96, 1e-6);
  for (std::size_t i = 1; i < row.size(); ++i) EXPECT_GE(row[i].first, row[i - 1].second) << i;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const FrameSample& sample = samples[i / 2];
    EXPECT_GE(row[i].first, static_cast<double>(sample.report.submitted_ns) * 1e-3);
    EXPECT_LE(row[i].second, static_cast<double>(sample.end_ns) * 1e-3);
  }
}

TEST(Trace, ends_no_frame_after_the_cpu_has_seen_its_end) {
  // The clocks have drifted apart by 2 µs between two frames.
  const auto row = gpu_row({frame(110'000, 10'000, 113'100), frame(230'000, 128'000, 233'100)});
  ASSERT_EQ(row.size(), 4u);
  EXPECT_LE(row[1].second, 113.1 + 1e-6);
  EXPECT_LE(row[3].second, 233.1 + 1e-6);
}

TEST(Trace, leaves_out_passes_that_were_not_timed) {
  FrameSample sample = frame(110'000, 10'000, 120'000);
  sample.report.passes[1].begin_ns = sample.report.passes[1].end_ns = 0;
  EXPECT_EQ(gpu_row({sample}).size(), 1u);
  sample.report.passes.clear();
  EXPECT_TRUE(gpu_row({sample}).empty());
}

TEST(Trace, holds_the_span_of_each_frame) {
  const auto trace =
      nlohmann::json::parse(chrome_trace(std::vector{frame(110'000, 0, 120'000), frame(115'000, 9'000, 130'000)}));
  std::map<int, std::pair<double, double>> spans;
  for (const auto& event : trace["traceEvents"]) {
    if (event["ph"] == "b") spans[event["id"]].first = event["ts"];
    if (event["ph"] == "e") spans[event["id"]].second = event["ts"];
  }
  ASSERT_EQ(spans.size(), 2u);
  EXPECT_DOUBLE_EQ(spans[0].first, 109.5);
  EXPECT_DOUBLE_EQ(spans[0].second, 120.0);
  EXPECT_DOUBLE_EQ(spans[1].first, 114.5);
  EXPECT_DOUBLE_EQ(spans[1].second, 130.0);
}

TEST(Trace, holds_zones_and_passes_in_microseconds) {
  FrameSample sample;
  sample.begin_ns = 5000;
  sample.end_ns = 2'000'000;
  sample.report.submitted_ns = 9000;
  sample.zones = {{.name = "transforms", .module = "engine", .begin_ns = 6000, .end_ns = 8500, .thread = 2}};
  sample.report.passes = {pass("geometry", 700, 1'500'700), pass("tone_map", 1'600'700, 1'850'700)};
  sample.report.passes[0].draws = 4;
  const auto trace = nlohmann::json::parse(chrome_trace(std::vector{sample}));

  std::map<std::string, nlohmann::json> events;
  for (const auto& event : trace["traceEvents"]) {
    if (event["ph"] == "X") events[event["name"]] = event;
  }
  ASSERT_EQ(events.size(), 3u);
  EXPECT_DOUBLE_EQ(events["transforms"]["ts"], 6.0);
  EXPECT_DOUBLE_EQ(events["transforms"]["dur"], 2.5);
  EXPECT_EQ(events["transforms"]["tid"], 2);
  EXPECT_EQ(events["transforms"]["cat"], "engine");
  EXPECT_DOUBLE_EQ(events["geometry"]["ts"], 9.0) << "the first pass begins with the submission";
  EXPECT_DOUBLE_EQ(events["geometry"]["dur"], 1500.0);
  EXPECT_EQ(events["geometry"]["args"]["draws"], 4);
  EXPECT_DOUBLE_EQ(events["tone_map"]["ts"], 1609.0) << "the gap of 100 µs is kept";
  EXPECT_DOUBLE_EQ(events["tone_map"]["dur"], 250.0);
  EXPECT_EQ(events["tone_map"]["tid"], events["geometry"]["tid"]);
  EXPECT_NE(events["tone_map"]["tid"], events["transforms"]["tid"]);
}

TEST(Trace, names_its_process_and_rows) {
  FrameSample sample;
  sample.zones = {{.name = "a", .module = "engine", .begin_ns = 0, .end_ns = 1, .thread = 3}};
  const auto trace = nlohmann::json::parse(chrome_trace(std::vector{sample, sample}));
  std::vector<std::string> rows;
  for (const auto& event : trace["traceEvents"]) {
    if (event["ph"] == "M") rows.push_back(event["args"]["name"]);
  }
  EXPECT_EQ(rows, (std::vector<std::string>{"gloam", "CPU 3", "GPU"}));
}

}  // namespace
}  // namespace gloam
