// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "modules/accuracy/outputs.h"

namespace gloam {
namespace {

/// `spread`: of the ratio's interval, to both sides.
LedgerRow point(const std::string& knob, double error, double ratio, double spread = 0.0) {
  LedgerRow row = {.knob = knob};
  row.flip = ErrorPair{.mean = error};
  row.ratio = ratio;
  row.ratio_low = ratio - spread;
  row.ratio_high = ratio + spread;
  row.ms.median_ms = 10.0 * ratio;
  row.sure_low = ratio - 1.5 * spread;
  row.sure_high = ratio + 1.5 * spread;
  return row;
}

std::vector<bool> front_of(std::vector<LedgerRow> rows) {
  mark_pareto_front(rows);
  std::vector<bool> front;
  for (const LedgerRow& row : rows) front.push_back(row.on_front);
  return front;
}

TEST(pareto_front, keeps_what_nothing_else_beats) {
  EXPECT_EQ(front_of({point("a", 0.0, 9.0), point("a", 0.1, 5.0), point("a", 0.2, 6.0), point("a", 0.3, 1.0)}),
            (std::vector<bool>{true, true, false, true}));
}

TEST(pareto_front, goes_by_ratios_for_times_drift) {
  std::vector<LedgerRow> rows = {point("a", 0.0, 1.0), point("a", 0.1, 0.5)};
  rows[0].ms.median_ms = 10.0;
  rows[1].ms.median_ms = 11.0;  // as if measured while the machine was busy
  EXPECT_EQ(front_of(rows), (std::vector<bool>{true, true}));
}

TEST(pareto_front, is_of_each_knob) {
  EXPECT_EQ(front_of({point("a", 0.5, 9.0), point("b", 0.0, 1.0)}), (std::vector<bool>{true, true}));
}

TEST(pareto_front, keeps_equals_and_of_equal_errors_the_cheapest) {
  EXPECT_EQ(front_of({point("a", 0.1, 2.0), point("a", 0.1, 2.0), point("a", 0.1, 3.0)}),
            (std::vector<bool>{true, true, false}));
}

TEST(pareto_front, takes_errors_below_the_noise_as_equal) {
  std::vector<LedgerRow> rows = {point("a", 0.001, 5.0), point("a", 0.003, 4.0)};
  for (LedgerRow& row : rows) row.reference_noise = 0.01;
  EXPECT_EQ(front_of(rows), (std::vector<bool>{false, true}));
  // More right by less than the noise, as cheap: neither makes the other pointless.
  rows = {point("a", 0.020, 1.0), point("a", 0.025, 1.0)};
  for (LedgerRow& row : rows) row.reference_noise = 0.01;
  EXPECT_EQ(front_of(rows), (std::vector<bool>{true, true}));
}

TEST(pareto_front, differences_in_time_inside_the_intervals_are_chance) {
  // The dearer one by chance is the more right one: it alone is left.
  EXPECT_EQ(front_of({point("a", 0.1, 1.00, 0.03), point("a", 0.2, 0.98, 0.03)}), (std::vector<bool>{true, false}));
  EXPECT_EQ(front_of({point("a", 0.1, 1.00, 0.03), point("a", 0.2, 0.90, 0.03)}), (std::vector<bool>{true, true}));
}

TEST(pareto_front, of_equal_pictures_it_keeps_the_significantly_cheaper_or_the_default) {
  std::vector<LedgerRow> rows = {point("a", 0.1, 0.98, 0.03), point("a", 0.1, 1.0), point("a", 0.0, 2.0)};
  rows[0].picture = rows[1].picture = "same";
  rows[2].picture = "other";
  rows[1].is_default = true;
  EXPECT_EQ(front_of(rows), (std::vector<bool>{false, true, true}));
  rows[0] = point("a", 0.1, 0.9, 0.03);
  rows[0].picture = "same";
  EXPECT_EQ(front_of(rows), (std::vector<bool>{true, false, true}));
}

TEST(pareto_front, gives_no_star_to_a_value_that_is_no_cheaper_than_the_default) {
  // The first lies between the default and the last, which is surely cheaper than the default.
  std::vector<LedgerRow> rows = {point("a", 0.1, 0.95, 0.1), point("a", 0.1, 1.0), point("a", 0.1, 0.9, 0.02)};
  for (LedgerRow& row : rows) row.picture = "same";
  rows[1].is_default = true;
  EXPECT_EQ(front_of(rows), (std::vector<bool>{false, false, true}));
}

TEST(pareto_front, has_no_value_of_a_knob_that_changes_nothing) {
  std::vector<LedgerRow> rows = {point("a", 0.1, 0.98, 0.03), point("a", 0.1, 1.0), point("a", 0.1, 1.02, 0.04)};
  for (LedgerRow& row : rows) row.picture = "same";
  rows[1].is_default = true;
  EXPECT_EQ(front_of(rows), (std::vector<bool>{false, false, false}));
  mark_pareto_front(rows);
  for (const LedgerRow& row : rows) EXPECT_TRUE(row.no_effect);
  rows[0].ratio_high = 0.99;
  mark_pareto_front(rows);
  EXPECT_TRUE(rows[0].no_effect) << "by chance";
  rows[0].sure_high = 0.98;
  rows[1].sure_low = 1.0;
  mark_pareto_front(rows);
  EXPECT_TRUE(rows[0].no_effect) << "another run would say otherwise";
  rows[0].sure_high = 0.96;
  mark_pareto_front(rows);
  EXPECT_TRUE(rows[0].on_front);
  EXPECT_FALSE(rows[0].no_effect);
}

TEST(pareto_front, leaves_out_rows_that_nobody_judged) {
  LedgerRow unjudged = {.knob = "a"};
  EXPECT_EQ(front_of({unjudged, point("a", 0.9, 9.0)}), (std::vector<bool>{false, true}));
  EXPECT_TRUE(front_of({}).empty());
}

TEST(pareto_front, goes_by_what_was_counted_before_pictures) {
  std::vector<LedgerRow> rows = {point("a", 0.0, 2.0), point("a", 0.0, 1.0), point("a", 0.0, 3.0)};
  const double counted[] = {1.0, 5.0, 2.0};
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].counted = CountedError{counted[i], "lights"};
  EXPECT_EQ(front_of(rows), (std::vector<bool>{true, true, false}));
}

TEST(pareto_front, a_wrong_row_is_on_none_and_keeps_no_other_off) {
  std::vector<LedgerRow> rows = {point("a", 0.0, 1.0), point("a", 0.1, 2.0)};
  rows[0].wrong = "lights are missing";
  EXPECT_EQ(front_of(rows), (std::vector<bool>{false, true}));
}

TEST(pareto_front, goes_by_linear_light_where_there_is_no_picture) {
  LedgerRow right = {.knob = "a", .rmse = 0.1};
  LedgerRow wrong = {.knob = "a", .rmse = 0.2};
  EXPECT_EQ(front_of({right, wrong}), (std::vector<bool>{true, false}));
}

/// The definition: a point is on the front if no point that is as cheap or cheaper has a smaller error.
TEST(pareto_front, agrees_with_brute_force) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    std::vector<LedgerRow> rows;
    const auto step = [&random] { return static_cast<double>(random() % 6) / 8.0; };
    for (auto left = random() % 20; left > 0; --left)
      rows.push_back(point(random() % 2 == 0 ? "a" : "b", step(), step()));
    const std::vector<bool> front = front_of(rows);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      bool beaten = false;
      for (std::size_t j = 0; j < rows.size(); ++j) {
        if (rows[j].knob != rows[i].knob) continue;
        const bool cheaper = rows[j].ratio < rows[i].ratio;
        const bool as_cheap = rows[j].ratio == rows[i].ratio;
        const bool better = rows[j].flip->mean < rows[i].flip->mean;
        const bool as_good = rows[j].flip->mean == rows[i].flip->mean;
        beaten = beaten || (cheaper && (better || as_good)) || (as_cheap && better);
      }
      EXPECT_EQ(front[i], !beaten);
    }
  }
}

TEST(pareto_front, a_difference_that_the_clock_cannot_resolve_is_none) {
  std::vector<LedgerRow> rows = {point("a", 0.1, 0.9, 0.02), point("a", 0.1, 1.0)};
  for (LedgerRow& row : rows) row.picture = "same";
  rows[1].is_default = true;
  for (LedgerRow& row : rows) row.ms.median_ms = 0.2 * row.ratio;
  EXPECT_EQ(front_of(rows), (std::vector<bool>{false, false}));
  for (LedgerRow& row : rows) row.ms.median_ms = 0.4 * row.ratio;
  EXPECT_EQ(front_of(rows), (std::vector<bool>{true, false}));
}

}  // namespace
}  // namespace gloam
