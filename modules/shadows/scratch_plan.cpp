// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/scratch_plan.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace gloam {
namespace {

std::size_t most_layers(std::uint32_t size) { return std::clamp(kScratchTexels / size / size, 1u, kMostScratchLayers); }

}  // namespace

ScratchPlan plan_scratch(std::span<const std::uint32_t> sizes) {
  ScratchPlan plan;
  std::vector<std::uint32_t> order(sizes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return sizes[a] > sizes[b]; });
  for (const std::uint32_t item : order) {
    const std::uint32_t size = sizes[item];
    if (plan.batches.empty() || plan.batches.back().size != size ||
        plan.batches.back().items.size() == most_layers(size))
      plan.batches.push_back({size, 0, {}});
    plan.batches.back().items.push_back(item);
  }
  // Few different images, so that frame plans are met again.
  for (ScratchPlan::Batch& batch : plan.batches)
    batch.layers = std::bit_ceil(static_cast<std::uint32_t>(batch.items.size()));
  return plan;
}

}  // namespace gloam
