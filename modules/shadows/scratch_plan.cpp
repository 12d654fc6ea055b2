// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/scratch_plan.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace gloam {
namespace {

/// Every second bit of a place along the Z-order curve, from bit 0 on.
std::uint32_t even_bits(std::uint64_t place) {
  std::uint32_t value = 0;
  for (std::uint32_t bit = 0; bit < 32; ++bit) value |= static_cast<std::uint32_t>(place >> (2 * bit) & 1u) << bit;
  return value;
}

/// Side of the least square of a power of two that holds the first `texels` of the curve.
std::uint32_t side_of(std::uint64_t texels) {
  std::uint32_t side = 1;
  while (std::uint64_t{side} * side < texels) side *= 2;
  return side;
}

}  // namespace

ScratchPlan plan_scratch(std::span<const std::uint32_t> sizes) {
  ScratchPlan plan;
  plan.side = kScratchSide;
  for (const std::uint32_t size : sizes) plan.side = std::max(plan.side, size);
  const std::uint64_t room = std::uint64_t{plan.side} * plan.side;
  // Large ones first along a Z-order curve: squares of powers of two then lie without gaps.
  std::vector<std::uint32_t> order(sizes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return sizes[a] > sizes[b]; });
  std::uint64_t used = room;
  for (const std::uint32_t item : order) {
    const std::uint64_t area = std::uint64_t{sizes[item]} * sizes[item];
    if (used + area > room) {
      plan.batches.emplace_back();
      used = 0;
    }
    plan.batches.back().places.push_back({item, uvec2(even_bits(used), even_bits(used >> 1))});
    used += area;
    plan.batches.back().side = side_of(used);
  }
  return plan;
}

}  // namespace gloam
