// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/trace.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gloam {
namespace {

TEST(Trace, holds_zones_and_passes_in_microseconds) {
  FrameSample sample;
  sample.begin_ns = 5000;
  sample.zones = {{.name = "transforms", .module = "engine", .begin_ns = 6000, .end_ns = 8500, .thread = 2}};
  sample.report.passes = {{.name = "geometry", .module = "engine", .ms = 1.5, .draws = 4},
                          {.name = "tone_map", .module = "lighting", .ms = 0.25}};
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
  EXPECT_DOUBLE_EQ(events["geometry"]["ts"], 5.0);
  EXPECT_DOUBLE_EQ(events["geometry"]["dur"], 1500.0);
  EXPECT_EQ(events["geometry"]["args"]["draws"], 4);
  EXPECT_DOUBLE_EQ(events["tone_map"]["ts"], 1505.0);
  EXPECT_EQ(events["tone_map"]["tid"], events["geometry"]["tid"]);
  EXPECT_NE(events["tone_map"]["tid"], events["transforms"]["tid"]);
}

TEST(Trace, names_its_rows) {
  FrameSample sample;
  sample.zones = {{.name = "a", .module = "engine", .begin_ns = 0, .end_ns = 1, .thread = 3}};
  const auto trace = nlohmann::json::parse(chrome_trace(std::vector{sample, sample}));
  std::vector<std::string> rows;
  for (const auto& event : trace["traceEvents"]) {
    if (event["ph"] == "M") rows.push_back(event["args"]["name"]);
  }
  EXPECT_EQ(rows, (std::vector<std::string>{"CPU 3", "GPU"}));
}

}  // namespace
}  // namespace gloam
