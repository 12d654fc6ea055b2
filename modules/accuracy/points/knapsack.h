// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Multiple-choice knapsack: of each group one option is chosen, and the sums of time and error count. The algorithm is
// dynamic programming over lists of undominated partial combinations (G. L. Nemhauser and Z. Ullmann, "Discrete Dynamic
// Programming and Capital Allocation", Management Science 15(9), 1969), which gives the answers for all budgets at
// once. Long lists are thinned over quantised time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gloam {

/// Both may be negative.
struct KnapsackOption {
  double time = 0.0;
  double error = 0.0;
};

/// One choice for each group, and the sums of the chosen options.
struct Combination {
  std::vector<std::uint8_t> chosen;
  double time = 0.0;
  double error = 0.0;
};

inline constexpr std::size_t kMostCombinations = 4096;

/// The combinations for which no other one takes at most their time with at most their error, by time, the fastest
/// first. Of combinations with equal sums, the one whose first differing group has the lower index. Groups: at least
/// one option each, at most 256. Exact as long as no step of the algorithm has more than `most` combinations; beyond
/// that it keeps the fastest, the most exact, and the one with the least error in each of `most` equal intervals of
/// time.
[[nodiscard]] std::vector<Combination> undominated_combinations(std::span<const std::vector<KnapsackOption>> groups,
                                                                std::size_t most = kMostCombinations);

}  // namespace gloam
