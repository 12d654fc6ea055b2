// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/points/knapsack.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "engine/core/assert.h"

namespace gloam {
namespace {

void keep_undominated(std::vector<Combination>& combinations) {
  std::ranges::sort(combinations, [](const Combination& a, const Combination& b) {
    return std::tie(a.time, a.error, a.chosen) < std::tie(b.time, b.error, b.chosen);
  });
  std::vector<Combination> kept;
  for (Combination& combination : combinations)
    if (kept.empty() || combination.error < kept.back().error) kept.push_back(std::move(combination));
  combinations = std::move(kept);
}

/// combinations: undominated, by time. So the last one of an interval of time has its least error.
void thin(std::vector<Combination>& combinations, std::size_t most) {
  if (combinations.size() <= most) return;
  const double begin = combinations.front().time;
  const double width = (combinations.back().time - begin) / static_cast<double>(most);
  const auto interval = [&](const Combination& combination) {
    return std::min(static_cast<std::size_t>((combination.time - begin) / width), most - 1);
  };
  std::vector<Combination> kept = {combinations.front()};
  for (std::size_t i = 1; i < combinations.size(); ++i)
    if (i + 1 == combinations.size() || interval(combinations[i]) != interval(combinations[i + 1]))
      kept.push_back(std::move(combinations[i]));
  combinations = std::move(kept);
}

}  // namespace

std::vector<Combination> undominated_combinations(std::span<const std::vector<KnapsackOption>> groups,
                                                  std::size_t most) {
  GLOAM_ASSERT(most > 0, "a combination is kept");
  std::vector<Combination> combinations(1);
  for (const std::vector<KnapsackOption>& options : groups) {
    GLOAM_ASSERT(!options.empty() && options.size() <= 256, "an option of each group is chosen, by an index of a byte");
    std::vector<Combination> longer;
    longer.reserve(combinations.size() * options.size());
    for (const Combination& combination : combinations)
      for (std::size_t i = 0; i < options.size(); ++i) {
        Combination& next = longer.emplace_back(combination);
        next.chosen.push_back(static_cast<std::uint8_t>(i));
        next.time += options[i].time;
        next.error += options[i].error;
      }
    keep_undominated(longer);
    thin(longer, most);
    combinations = std::move(longer);
  }
  return combinations;
}

}  // namespace gloam
