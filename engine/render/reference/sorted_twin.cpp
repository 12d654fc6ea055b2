// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/reference/sorted_twin.h"

#include <algorithm>
#include <numeric>

#include "engine/render/sort/radix_sort.h"

namespace gloam {

SortedTwin sorted_twin(const std::vector<std::uint8_t>& keys, const std::vector<std::uint32_t>& values) {
  constexpr std::size_t kBins = 256;
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return keys[i]; });
  SortedTwin sorted;
  for (const std::uint32_t i : order) {
    sorted.values.push_back(values.empty() ? i : values[i]);
    sorted.keys.push_back(keys[i]);
  }
  sorted.bins.assign(kBins + 1, 0);
  for (const std::uint8_t key : keys) ++sorted.bins[key + 1u];
  std::partial_sum(sorted.bins.begin(), sorted.bins.end(), sorted.bins.begin());
  return sorted;
}

std::vector<std::uint8_t> packed_keys(const std::vector<std::uint8_t>& keys) {
  std::vector<std::uint8_t> bytes(packed_key_bytes(static_cast<std::uint32_t>(keys.size())), 0x5A);
  std::ranges::copy(keys, bytes.begin());
  return bytes;
}

}  // namespace gloam
