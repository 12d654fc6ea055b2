// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/results/heat_fit.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "modules/module_list/module_list.h"
#include "sandbox/session/program_knobs.h"

namespace gloam {
namespace {

constexpr std::array kFactors = {0.25f, 0.5f, 1.0f, 2.0f};

TEST(FittingFactor, is_the_smallest_one_that_the_numbers_fit_in) {
  const std::vector<float> numbers(2000, 0.0f);
  const auto with = [&](float most) {
    std::vector<float> some = numbers;
    std::fill(some.begin(), some.begin() + 100, most);
    return fitting_factor(some, 10.0, kFactors);
  };
  EXPECT_EQ(with(1.0f), 0.25f);
  EXPECT_EQ(with(2.5f), 0.25f);
  EXPECT_EQ(with(2.6f), 0.5f);
  EXPECT_EQ(with(10.0f), 1.0f);
  EXPECT_EQ(with(10.1f), 2.0f);
  EXPECT_EQ(with(1e6f), 2.0f);
}

TEST(FittingFactor, ignores_one_in_a_thousand_and_what_is_not_a_number) {
  std::vector<float> numbers(10000, 2.0f);
  for (std::size_t i = 0; i < 5; ++i) numbers[i * 1000] = 500.0f;
  numbers[1] = std::numeric_limits<float>::infinity();
  numbers[2] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(fitting_factor(numbers, 10.0, kFactors), 0.25f);
}

TEST(FittingFactor, is_1_without_a_number_above_0) {
  EXPECT_EQ(fitting_factor({}, 10.0, kFactors), 1.0f);
  EXPECT_EQ(fitting_factor(std::vector<float>{-1.0f, 0.0f}, 10.0, kFactors), 1.0f);
}

TEST(FittingFactor, of_counts_ends_at_the_next_of_some_multiples_of_5) {
  const auto end = [](float largest) {
    const std::vector<float> numbers(10, largest);
    const double factor = static_cast<double>(fitting_factor_of_counts(numbers, 31.0));
    return factor * 31.0;
  };
  for (const auto& [largest, expected] : {std::pair(1.0f, 5.0),
                                          {5.0f, 5.0},
                                          {6.0f, 10.0},
                                          {21.0f, 25.0},
                                          {31.0f, 40.0},
                                          {40.0f, 40.0},
                                          {41.0f, 50.0},
                                          {51.0f, 60.0},
                                          {81.0f, 100.0},
                                          {399.0f, 400.0},
                                          {601.0f, 800.0},
                                          {12345.0f, 15000.0}})
    EXPECT_NEAR(end(largest), expected, 1e-5 * expected) << largest;
  EXPECT_EQ(fitting_factor_of_counts({}, 31.0), 1.0f);
  EXPECT_EQ(fitting_factor_of_counts(std::vector<float>(9, 0.0f), 31.0), 1.0f);
}

TEST(HeatRanges, are_the_factors_of_the_knob_in_order) {
  KnobRegistry knobs = all_knobs(make_all_modules());
  const std::vector<float> ranges = heat_ranges(knobs);
  EXPECT_EQ(ranges, (std::vector<float>{1.0f / 16, 0.125f, 0.25f, 0.5f, 1.0f, 2.0f, 4.0f, 8.0f, 16.0f}));
  EXPECT_FALSE(fits_heat_range(knobs));
  ASSERT_TRUE(knobs.set("views.range", "1/4").ok());
  EXPECT_EQ(heat_range(knobs), 0.25f);
  ASSERT_TRUE(knobs.set("views.range", "fit").ok());
  EXPECT_TRUE(fits_heat_range(knobs));
  EXPECT_EQ(heat_range(knobs), 1.0f);
}

}  // namespace
}  // namespace gloam
