// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/points/cost_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "modules/accuracy/points/point_choice.h"
#include "modules/accuracy/points/point_measurement.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

LedgerRow row_of(const std::string& knob, const std::string& value, double ratio, double whole, bool standard = false) {
  LedgerRow row = {.knob = knob, .value = value, .is_default = standard};
  row.whole = WholeError{.flip = {whole, whole}};
  row.ratio = ratio;
  row.ratio_low = standard ? 1.0 : ratio - 0.01;
  row.ratio_high = standard ? 1.0 : ratio + 0.01;
  return row;
}

KnobRegistry knobs_abc() {
  KnobRegistry knobs;
  for (const char* name : {"k.a", "k.b", "k.c"})
    knobs.add({.name = name, .module = "k", .choices = {"low", "mid", "high"}, .default_number = 1});
  return knobs;
}

std::vector<LedgerRow> rows_abc() {
  return {row_of("k.a", "low", 0.8, 0.05),    row_of("k.a", "mid", 1.0, 0.03, true), row_of("k.a", "high", 1.5, 0.01),
          row_of("k.b", "low", 0.7, 0.1),     row_of("k.b", "mid", 1.0, 0.03, true), row_of("k.b", "high", 1.2, 0.029),
          row_of("k.c", "low", 0.995, 0.031), row_of("k.c", "mid", 1.0, 0.03, true), row_of("k.c", "high", 2.0, 0.02)};
}

TEST(CostModel, adds_differences_of_time_and_of_squared_errors) {
  const CostModel model(rows_abc(), knobs_abc());
  EXPECT_DOUBLE_EQ(model.predict({}).ratio, 1.0);
  EXPECT_DOUBLE_EQ(model.predict({}).error(), 0.03);
  const Cost both = model.predict({{"k.a", "low"}, {"k.b", "low"}});
  EXPECT_DOUBLE_EQ(both.ratio, 0.5);
  EXPECT_DOUBLE_EQ(both.error(), std::sqrt(0.05 * 0.05 + 0.1 * 0.1 - 0.03 * 0.03));
  const Cost better = model.predict({{"k.a", "high"}, {"k.c", "high"}});
  EXPECT_DOUBLE_EQ(better.ratio, 2.5);
  EXPECT_EQ(better.error(), 0.0) << "below 0 is 0";
  EXPECT_DOUBLE_EQ(model.predict({{"k.c", "low"}}).ratio, 1.0) << "its saving is within the noise";
  std::vector<LedgerRow> rows = rows_abc();
  rows[0].whole->flip.mean = 0.03 - 9e-5;
  EXPECT_DOUBLE_EQ(CostModel(rows, knobs_abc()).predict({{"k.a", "low"}}).error(), 0.03) << "nobody sees that";
}

TEST(CostModel, does_not_vary_what_is_kept_of_the_last_frame) {
  KnobRegistry knobs = knobs_abc();
  knobs.add({.name = "shadows.reuse", .module = "shadows", .choices = {"off", "exact"}, .default_number = 1});
  ASSERT_TRUE(knobs.set("shadows.reuse", "off").ok());
  std::vector<LedgerRow> rows = rows_abc();
  rows.push_back(row_of("shadows.reuse", "off", 1.0, 0.03));
  rows.push_back(row_of("shadows.reuse", "exact", 0.1, 0.03, true));  // at rest
  const CostModel model(rows, knobs);
  for (const auto& knob : model.knobs()) EXPECT_NE(knob.name, "shadows.reuse");
  EXPECT_THAT(settings_with(knobs, {{"k.a", "low"}}), SizeIs(1)) << "it is off for the measurement alone";
}

TEST(CostModel, does_not_vary_wrong_values_looks_and_knobs_without_effect) {
  std::vector<LedgerRow> rows = rows_abc();
  rows[0].wrong = "a light is missing";
  for (std::size_t i = 3; i < 6; ++i) rows[i].no_effect = true;
  KnobRegistry knobs = knobs_abc();
  rows.push_back(row_of("k.look", "red", 0.5, 0.0));
  rows.push_back(row_of("k.look", "blue", 1.0, 0.03, true));
  knobs.add({.name = "k.look", .module = "k", .choices = {"red", "blue"}, .default_number = 1, .is_look = true});
  rows.push_back(row_of("k.old", "red", 0.5, 0.0));
  rows.back().whole.reset();
  knobs.add({.name = "k.old", .module = "k", .choices = {"red", "blue"}, .default_number = 1});
  const CostModel model(rows, knobs);
  ASSERT_THAT(model.knobs(), SizeIs(2));
  EXPECT_EQ(model.knobs()[0].name, "k.a");
  EXPECT_THAT(model.knobs()[0].options, SizeIs(2)) << "the default and high";
  EXPECT_EQ(model.knobs()[1].name, "k.c");
}

TEST(CostModel, counts_from_the_users_value) {
  KnobRegistry knobs = knobs_abc();
  ASSERT_TRUE(knobs.set("k.a", "low").ok());
  const CostModel model(rows_abc(), knobs);
  EXPECT_DOUBLE_EQ(model.predict({}).ratio, 1.0);
  EXPECT_DOUBLE_EQ(model.predict({{"k.a", "high"}}).ratio, 1.5 / 0.8);
}

/// k.b halves the frame's pixels; k.c works only while k.a is not low.
KnobRegistry knobs_that_depend() {
  KnobRegistry knobs;
  knobs.add({.name = "k.a", .module = "k", .choices = {"low", "mid", "high"}, .default_number = 1});
  knobs.add(
      {.name = "k.b", .module = "k", .choices = {"low", "mid", "high"}, .default_number = 1, .scales_frame = true});
  knobs.add({.name = "k.c",
             .module = "k",
             .choices = {"low", "mid", "high"},
             .default_number = 1,
             .only_with = "k.a=mid|high"});
  return knobs;
}

TEST(CostModel, a_knob_that_scales_the_frame_multiplies_the_others) {
  const CostModel model(rows_abc(), knobs_that_depend());
  EXPECT_DOUBLE_EQ(model.predict({{"k.a", "low"}, {"k.b", "low"}}).ratio, 0.8 * 0.7);
  EXPECT_DOUBLE_EQ(model.predict({{"k.a", "high"}, {"k.b", "low"}, {"k.c", "high"}}).ratio, 2.5 * 0.7);
  const Cost measured = {.ratio = 0.6, .squared_error = 0.01};
  const Changes scaled = {{"k.b", "low"}};
  EXPECT_DOUBLE_EQ(model.predict_from(measured, scaled, model.knobs()[0], model.knobs()[0].options[1]).ratio,
                   0.6 - 0.2 * 0.7);
  EXPECT_DOUBLE_EQ(model.predict_from(measured, scaled, model.knobs()[1], model.knobs()[1].options[0]).ratio,
                   0.6 / 0.7);
}

TEST(CostModel, leaves_out_changes_that_the_others_make_pointless) {
  const CostModel model(rows_abc(), knobs_that_depend());
  EXPECT_EQ(model.folded({{"k.a", "low"}, {"k.c", "high"}}), (Changes{{"k.a", "low"}}));
  EXPECT_EQ(model.folded({{"k.a", "high"}, {"k.c", "high"}}), (Changes{{"k.a", "high"}, {"k.c", "high"}}));
  std::set<Changes> seen;
  double last = 0.0;
  for (const Changes& changes : model.front()) {
    EXPECT_EQ(model.folded(changes), changes);
    EXPECT_TRUE(seen.insert(changes).second) << "each is there once";
    EXPECT_GT(model.predict(changes).ratio, last);
    last = model.predict(changes).ratio;
  }
  // The front is that of all folded combinations.
  for (const std::string a : {"low", "mid", "high"})
    for (const std::string b : {"low", "mid", "high"})
      for (const std::string c : {"low", "mid", "high"}) {
        const Cost cost = model.predict(model.folded({{"k.a", a}, {"k.b", b}, {"k.c", c}}));
        EXPECT_TRUE(std::ranges::any_of(seen,
                                        [&](const Changes& kept) {
                                          const Cost other = model.predict(kept);
                                          return other.ratio <= cost.ratio + 1e-12 &&
                                                 other.squared_error <= cost.squared_error + 1e-12;
                                        }))
            << a << b << c;
      }
}

TEST(CostModel, its_front_is_that_of_all_combinations) {
  const KnobRegistry knobs = knobs_abc();
  const CostModel model(rows_abc(), knobs);
  std::vector<std::pair<double, double>> all, front;
  for (const std::string a : {"low", "mid", "high"})
    for (const std::string b : {"low", "mid", "high"})
      for (const std::string c : {"low", "mid", "high"}) {
        const Cost cost = model.predict({{"k.a", a}, {"k.b", b}, {"k.c", c}});
        all.emplace_back(cost.ratio, cost.squared_error);
      }
  for (const Changes& changes : model.front()) {
    const Cost cost = model.predict(changes);
    front.emplace_back(cost.ratio, cost.squared_error);
    for (const auto& [knob, value] : changes) EXPECT_NE(value, "mid") << "the user's value is no change";
  }
  constexpr double kRounding = 1e-12;
  for (const auto& [time, error] : all) {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [t, e] : front)
      if (t <= time + kRounding) best = std::min(best, e);
    EXPECT_LE(best, error + kRounding) << "at " << time;
  }
  for (std::size_t i = 1; i < front.size(); ++i) {
    EXPECT_GT(front[i].first, front[i - 1].first);
    EXPECT_LT(front[i].second, front[i - 1].second);
  }
}

TEST(PointChoice, spreads_over_the_front_with_both_ends) {
  const KnobRegistry knobs = knobs_abc();
  const CostModel model(rows_abc(), knobs);
  const std::vector<Changes> front = model.front();
  ASSERT_GT(front.size(), 5u);
  for (std::size_t count = 2; count <= front.size() + 2; ++count) {
    const std::vector<Changes> chosen = spread(model, front, count);
    ASSERT_EQ(chosen.size(), std::min(count, front.size()));
    EXPECT_EQ(chosen.front(), front.front());
    EXPECT_EQ(chosen.back(), front.back());
    for (std::size_t i = 1; i < chosen.size(); ++i)
      EXPECT_GT(model.predict(chosen[i]).ratio, model.predict(chosen[i - 1]).ratio);
  }
  EXPECT_THAT(spread(model, front, 0), IsEmpty());
}

TEST(PointChoice, improves_between_the_points_of_the_measured_front) {
  KnobRegistry knobs = knobs_abc();
  const CostModel model(rows_abc(), knobs);
  std::vector<MeasuredCost> measured = {{{}, model.predict({})}, {{{"k.b", "low"}}, model.predict({{"k.b", "low"}})}};
  Improvements improvements;
  const auto next = improve(model, measured, improvements);
  ASSERT_TRUE(next.has_value());
  EXPECT_THAT(*next, ElementsAre(std::pair<const std::string, std::string>("k.a", "low")))
      << "0.8 of the time at 0.05, where the line is at 0.067";
  measured.push_back({*next, {.ratio = 0.8, .squared_error = 0.01}});
  const auto other = improve(model, measured, improvements);
  EXPECT_TRUE(!other || *other != *next) << "nothing is measured twice";
}

TEST(PointChoice, fills_the_widest_gap_before_it_improves_a_narrow_one) {
  std::vector<LedgerRow> rows = rows_abc();
  rows[6] = row_of("k.c", "low", 1.3, 0.02);
  const CostModel model(rows, knobs_abc());
  // Between the last two, k.c=low would be far below the line; but k.a=low lies in a gap of more than a factor of two.
  std::vector<MeasuredCost> measured = {{{{"k.a", "low"}, {"k.b", "low"}}, {.ratio = 0.4, .squared_error = 0.04}},
                                        {{}, {.ratio = 1.0, .squared_error = 0.0009}},
                                        {{{"k.a", "high"}}, {.ratio = 1.35, .squared_error = 0.00088}}};
  Improvements improvements;
  EXPECT_EQ(improve(model, measured, improvements), (Changes{{"k.a", "low"}}));
  measured.push_back({{{"k.a", "low"}}, {.ratio = 0.8, .squared_error = 0.0025}});
  EXPECT_EQ(improve(model, measured, improvements), (Changes{{"k.c", "low"}}));
}

TEST(PointChoice, gives_up_if_no_neighbour_is_near_the_front) {
  KnobRegistry knobs = knobs_abc();
  const CostModel model(rows_abc(), knobs);
  // Measured far better than predicted: no neighbour comes near.
  const std::vector<MeasuredCost> measured = {{{}, {.ratio = 1.0, .squared_error = 1e-8}},
                                              {{{"k.b", "low"}}, {.ratio = 0.7, .squared_error = 2e-8}}};
  Improvements improvements;
  EXPECT_FALSE(improve(model, measured, improvements).has_value());
}

}  // namespace
}  // namespace gloam
