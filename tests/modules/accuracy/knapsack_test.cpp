// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/points/knapsack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

namespace gloam {
namespace {

using Groups = std::vector<std::vector<KnapsackOption>>;
using Sums = std::vector<std::pair<double, double>>;

/// Integers, so that sums are exact and many are equal.
Groups random_groups(std::mt19937& random, std::size_t most_groups, std::size_t most_options, int range) {
  std::uniform_int_distribution<int> number(-range, range);
  Groups groups(random() % most_groups + 1);
  for (auto& options : groups) {
    options.resize(random() % most_options + 1);
    for (KnapsackOption& option : options)
      option = {static_cast<double>(number(random)), static_cast<double>(number(random))};
  }
  return groups;
}

/// Time and error of every combination.
Sums all_sums(const Groups& groups) {
  Sums sums = {{0.0, 0.0}};
  for (const auto& options : groups) {
    Sums longer;
    for (const auto& [time, error] : sums)
      for (const KnapsackOption& option : options) longer.emplace_back(time + option.time, error + option.error);
    sums = std::move(longer);
  }
  return sums;
}

/// By comparing each with each.
Sums brute_front(const Groups& groups) {
  const Sums all = all_sums(groups);
  Sums front;
  for (const auto& a : all) {
    const bool dominated =
        std::ranges::any_of(all, [&](const auto& b) { return b.first <= a.first && b.second <= a.second && b != a; });
    if (!dominated) front.push_back(a);
  }
  std::ranges::sort(front);
  front.erase(std::unique(front.begin(), front.end()), front.end());
  return front;
}

Sums sums_of(const std::vector<Combination>& combinations) {
  Sums sums;
  for (const Combination& combination : combinations) sums.emplace_back(combination.time, combination.error);
  return sums;
}

void expect_sums_of_choices(const std::vector<Combination>& combinations, const Groups& groups) {
  for (const Combination& combination : combinations) {
    ASSERT_EQ(combination.chosen.size(), groups.size());
    double time = 0.0, error = 0.0;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      ASSERT_LT(combination.chosen[i], groups[i].size());
      time += groups[i][combination.chosen[i]].time;
      error += groups[i][combination.chosen[i]].error;
    }
    EXPECT_EQ(combination.time, time);
    EXPECT_EQ(combination.error, error);
  }
}

TEST(Knapsack, finds_what_trying_all_combinations_finds) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const Groups groups = random_groups(random, 5, 4, trial % 2 == 0 ? 3 : 1000);
    const auto front = undominated_combinations(groups);
    EXPECT_EQ(sums_of(front), brute_front(groups)) << "trial " << trial;
    expect_sums_of_choices(front, groups);
  }
}

TEST(Knapsack, of_equal_sums_it_takes_the_first_options) {
  const Groups groups = {{{0, 0}, {0, 0}, {-1, 1}}, {{0, 0}, {-1, 1}}};
  const auto front = undominated_combinations(groups);
  ASSERT_EQ(sums_of(front), (Sums{{-2, 2}, {-1, 1}, {0, 0}}));
  EXPECT_EQ(front[1].chosen, (std::vector<std::uint8_t>{0, 1}));
  EXPECT_EQ(front[2].chosen, (std::vector<std::uint8_t>{0, 0}));
}

TEST(Knapsack, of_no_groups_is_one_empty_combination) {
  EXPECT_EQ(sums_of(undominated_combinations({})), (Sums{{0.0, 0.0}}));
}

TEST(Knapsack, a_thinned_front_keeps_its_ends_and_stays_near) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const Groups groups = random_groups(random, 12, 6, 100000);
    const Sums exact = sums_of(undominated_combinations(groups, 1'000'000));
    constexpr std::size_t kMost = 64;
    const auto thinned = undominated_combinations(groups, kMost);
    expect_sums_of_choices(thinned, groups);
    ASSERT_LE(thinned.size(), kMost + 1);
    const Sums sums = sums_of(thinned);
    EXPECT_EQ(sums.front(), exact.front());
    EXPECT_EQ(sums.back(), exact.back());
    // Each step moves a combination by at most one interval, so the error at a time is at most that of the exact front
    // a few intervals earlier.
    const double slack = (exact.back().first - exact.front().first) / kMost * static_cast<double>(groups.size());
    for (const auto& [time, error] : exact) {
      const auto near = std::ranges::find_if(sums, [&, e = error](const auto& sum) { return sum.second <= e; });
      ASSERT_NE(near, sums.end());
      EXPECT_LE(near->first, time + slack);
    }
  }
}

}  // namespace
}  // namespace gloam
