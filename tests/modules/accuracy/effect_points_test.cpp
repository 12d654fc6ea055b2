// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "modules/accuracy/module.h"

namespace gloam {
namespace {

LedgerRow effect_row(const std::string& knob, const std::string& value, double module_ms, double error,
                     bool standard = false) {
  LedgerRow row = {.knob = knob, .value = value, .is_default = standard};
  row.whole = WholeError{.flip = {error, error}};
  row.ratio = row.ratio_low = row.ratio_high = 1.0;  // of the whole frame, in which the module is small
  row.module_gpu_ms = module_ms;
  return row;
}

KnobRegistry effect_knobs() {
  KnobRegistry knobs;
  knobs.add({.name = "fog.steps", .module = "fog", .choices = {"few", "some", "many"}, .default_number = 1});
  knobs.add({.name = "fog.light", .module = "fog", .choices = {"flat", "full"}, .default_number = 1});
  knobs.add({.name = "grass.far", .module = "grass", .choices = {"near", "wide"}, .default_number = 1});
  return knobs;
}

Ledger effect_ledger() {
  Ledger ledger;
  ledger.rows = {effect_row("fog.steps", "few", 2.0, 0.05),        effect_row("fog.steps", "some", 4.0, 0.03, true),
                 effect_row("fog.steps", "many", 9.0, 0.01),       effect_row("fog.light", "flat", 3.0, 0.04),
                 effect_row("fog.light", "full", 4.0, 0.03, true), effect_row("grass.far", "near", 0.5, 0.06),
                 effect_row("grass.far", "wide", 0.0, 0.03, true)};
  return ledger;
}

const FrontPoint* point_with(const std::vector<FrontPoint>& points, const std::vector<std::string>& settings) {
  for (const FrontPoint& point : points) {
    std::vector<std::string> own;
    for (const KnobOverride& setting : point.settings) own.push_back(setting.name + "=" + setting.value);
    if (own == settings) return &point;
  }
  return nullptr;
}

TEST(EffectPoints, have_the_time_of_the_effects_own_passes) {
  KnobRegistry knobs = effect_knobs();
  ASSERT_TRUE(knobs.set("fog.steps", "few").ok()) << "points do not depend on the present values";
  const std::vector<FrontPoint> points = effect_points(effect_ledger(), "fog", knobs);
  const FrontPoint* const standard = point_with(points, {});
  ASSERT_NE(standard, nullptr);
  EXPECT_DOUBLE_EQ(standard->ms, 4.0);
  EXPECT_DOUBLE_EQ(standard->error, 0.03);
  const FrontPoint* const least = point_with(points, {"fog.steps=few", "fog.light=flat"});
  ASSERT_NE(least, nullptr);
  EXPECT_EQ(least, &points.front());
  EXPECT_DOUBLE_EQ(least->ms, 1.0) << "4 less 2 less 1";
  EXPECT_DOUBLE_EQ(least->error, std::sqrt(0.05 * 0.05 + 0.04 * 0.04 - 0.03 * 0.03));
  EXPECT_DOUBLE_EQ(points.back().ms, 9.0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_GT(points[i].ms, points[i - 1].ms);
    EXPECT_LT(points[i].error, points[i - 1].error);
  }
}

TEST(EffectPoints, points_are_some_percent_apart_and_the_most_exact_one_stays) {
  Ledger ledger = effect_ledger();
  ledger.rows[2] = effect_row("fog.steps", "many", 4.21, 0.01);  // 5.25 % more than the default
  ledger.rows[3] = effect_row("fog.light", "flat", 3.76, 0.04);
  const std::vector<FrontPoint> points = effect_points(ledger, "fog", effect_knobs());
  for (std::size_t i = 1; i < points.size(); ++i) EXPECT_GT(points[i].ms, 1.02 * points[i - 1].ms);
  EXPECT_NE(point_with(points, {"fog.steps=many"}), nullptr);
}

TEST(EffectPoints, an_effect_may_be_switched_off) {
  Ledger ledger = effect_ledger();
  ledger.rows[3] = effect_row("fog.light", "flat", 0.0, 0.2);
  const std::vector<FrontPoint> points = effect_points(ledger, "fog", effect_knobs());
  EXPECT_EQ(&points.front(), point_with(points, {"fog.light=flat"}));
  EXPECT_GT(points.front().ms, 0.0) << "the renderer takes no setting without a time";
  EXPECT_LT(points.front().ms, 0.1);
}

TEST(EffectPoints, without_rows_or_passes_there_are_none) {
  EXPECT_TRUE(effect_points(effect_ledger(), "smoke", effect_knobs()).empty());
  EXPECT_TRUE(effect_points(effect_ledger(), "grass", effect_knobs()).empty()) << "no time by default";
  EXPECT_TRUE(effect_points({}, "fog", effect_knobs()).empty());
}

TEST(FrontPoints, times_are_those_on_the_wall_and_keep_their_ratios) {
  Ledger ledger;
  for (const double ms : {10.0, 20.0, 40.0}) {
    LedgerPoint& point = ledger.points.emplace_back();
    point.measured.ms.median_ms = ms;
    point.measured.wall_ms = 1.5 * ms;
    point.measured.flip = ErrorPair{0.1, 0.2};
  }
  ledger.points[2].measured.wall_ms = 400.0;  // beside other work
  const std::vector<FrontPoint> points = front_points(ledger);
  ASSERT_EQ(points.size(), 3u);
  EXPECT_DOUBLE_EQ(points[0].ms, 15.0);
  EXPECT_DOUBLE_EQ(points[2].ms, 60.0);
  for (LedgerPoint& point : ledger.points) point.measured.wall_ms = 0.0;
  EXPECT_DOUBLE_EQ(front_points(ledger)[1].ms, 20.0) << "a ledger without";
  ledger.points[1].measured.flip.reset();
  EXPECT_EQ(front_points(ledger).size(), 2u);
}

}  // namespace
}  // namespace gloam
