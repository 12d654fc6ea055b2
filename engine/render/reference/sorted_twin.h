// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// CPU twin of the radix sort: std::stable_sort.
#pragma once

#include <cstdint>
#include <vector>

namespace gloam {

struct SortedTwin {
  std::vector<std::uint32_t> values;
  std::vector<std::uint8_t> keys;
  std::vector<std::uint32_t> bins;  ///< 257: exclusive prefix sum of the histogram
};

/// values: as many as keys; empty: value i is i.
[[nodiscard]] SortedTwin sorted_twin(const std::vector<std::uint8_t>& keys, const std::vector<std::uint32_t>& values);

/// The bytes of a buffer of packed keys. What follows the last key has any content.
[[nodiscard]] std::vector<std::uint8_t> packed_keys(const std::vector<std::uint8_t>& keys);

}  // namespace gloam
