// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/stability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace gloam {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

StabilityCheck curve(std::vector<StabilityPoint> points) {
  return {.name = "moved.lamp",
          .kind = StabilityKind::curve,
          .sentence = "a lamp, moved",
          .unit = "of 255",
          .bound = 0.5,
          .advice = "Stay near the origin",
          .axis = "distance, m",
          .promised = StabilityRange{1.0, 100.0},
          .worst = 0.25,
          .worst_case = "100 m",
          .curve = std::move(points)};
}

TEST(Stability, holds_up_to_the_bound_and_only_for_numbers) {
  StabilityCheck check = {.bound = 0.5, .worst = 0.5};
  EXPECT_TRUE(holds(check));
  for (const double worst : {0.50001, kInfinity, kNan}) {
    check.worst = worst;
    EXPECT_FALSE(holds(check)) << worst;
  }
  check = {.bound = 0.0, .worst = 0.0};
  EXPECT_TRUE(holds(check));
  check.fault = "no such file";
  EXPECT_FALSE(holds(check));
  check.skipped = "the device has one width";
  EXPECT_TRUE(holds(check));
}

// Hard case: selftest.validity
TEST(Stability, the_range_is_the_widest_run_of_points_that_keep_the_bound) {
  const auto range = range_within_bound(curve({{0.1, 0.9}, {1, 0.1}, {10, 0.2}, {100, 0.5}, {1e3, 0.6}, {1e4, 0.1}}));
  ASSERT_TRUE(range);
  EXPECT_EQ(*range, (StabilityRange{1.0, 100.0}));
  EXPECT_EQ(range_within_bound(curve({{10, 0.2}, {1, 0.1}})), (StabilityRange{1.0, 10.0})) << "points that descend";
  EXPECT_FALSE(range_within_bound(curve({{1, 0.9}, {10, kNan}})));
  EXPECT_FALSE(range_within_bound(curve({{1e3, 0.1}, {1e4, 0.1}}))) << "it does not reach what is promised";
  EXPECT_FALSE(range_within_bound(curve({})));
}

TEST(Stability, a_line_says_what_failed_and_what_to_do) {
  StabilityCheck check = curve({{1, 0.1}, {100, 0.25}});
  EXPECT_THAT(stability_line(check), HasSubstr("0.250 of 255, bound 0.500 (100 m): margin 2, holds 1 to 100"));
  check.worst = 0.75;
  EXPECT_THAT(stability_line(check), HasSubstr("FAILED. Stay near the origin"));
  check.fault = "the device is lost";
  EXPECT_THAT(stability_line(check), HasSubstr("FAILED: the device is lost"));
  check.skipped = "no GPU";
  EXPECT_THAT(stability_line(check), HasSubstr("skipped: no GPU"));
}

StabilityReport report_of_two() {
  StabilityCheck bad = curve({{1, 0.1}, {10, kNan}});
  bad.name = "<bad>";
  bad.worst = kNan;
  return {.gloam = "1.0", .device = "llvmpipe", .host = "host", .seconds = 2.0, .checks = {curve({{1, 0.1}}), bad}};
}

TEST(Stability, json_has_every_check_and_its_curve) {
  const auto json = nlohmann::json::parse(stability_json(report_of_two()));
  EXPECT_EQ(json["failed"], 1);
  EXPECT_EQ(json["device"]["name"], "llvmpipe");
  ASSERT_EQ(json["checks"].size(), 2u);
  EXPECT_EQ(json["checks"][0]["holds"], true);
  EXPECT_EQ(json["checks"][0]["within_bound"][1], 1.0);
  EXPECT_FALSE(json["checks"][0].contains("advice"));
  EXPECT_EQ(json["checks"][1]["holds"], false);
  EXPECT_TRUE(json["checks"][1]["worst"].is_null());
  EXPECT_EQ(json["checks"][1]["points"][0][1], 0.1);
  EXPECT_TRUE(json["checks"][1]["points"][1][1].is_null());
  EXPECT_EQ(json["checks"][1]["advice"], "Stay near the origin");
}

TEST(Stability, json_is_read_back) {
  const StabilityReport report = report_of_two();
  const auto read = parse_stability_json(stability_json(report));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(stability_json(*read), stability_json(report));
  for (const char* text : {"", "{}", "[1]", R"({"device": 3})"})
    EXPECT_EQ(parse_stability_json(text).error().kind, ErrorKind::input) << text;
}

TEST(Stability, the_page_stands_alone_and_shows_bounds_and_curves) {
  const std::string html = stability_html(report_of_two());
  EXPECT_THAT(html, HasSubstr("1 of 2 checks failed"));
  EXPECT_THAT(html, HasSubstr("<svg class=\"plot limits\""));
  EXPECT_THAT(html, HasSubstr("class=\"bound\""));
  EXPECT_THAT(html, HasSubstr("&lt;bad&gt;"));
  for (const char* other : {"<bad>", "http://", "https://", "nan,", "inf,"}) EXPECT_THAT(html, Not(HasSubstr(other)));
}

}  // namespace
}  // namespace gloam
