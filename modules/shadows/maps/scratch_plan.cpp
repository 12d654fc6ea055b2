// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/maps/scratch_plan.h"

#include <algorithm>
#include <numeric>

namespace gloam {
namespace {

std::size_t most_layers(std::uint32_t size, std::uint32_t most_texels) {
  return std::clamp(most_texels / size / size, 1u, kMostScratchLayers);
}

}  // namespace

ScratchPlan plan_scratch(std::span<const std::uint32_t> sizes, std::uint32_t most_texels) {
  ScratchPlan plan;
  std::vector<std::uint32_t> order(sizes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return sizes[a] > sizes[b]; });
  for (const std::uint32_t item : order) {
    const std::uint32_t size = sizes[item];
    if (plan.batches.empty() || plan.batches.back().size != size ||
        plan.batches.back().items.size() == most_layers(size, most_texels))
      plan.batches.push_back({size, {}});
    plan.batches.back().items.push_back(item);
  }
  return plan;
}

std::uint64_t ScratchPlan::texels() const {
  std::uint64_t most = 0;
  for (const Batch& batch : batches) most = std::max<std::uint64_t>(most, batch.items.size() * batch.size * batch.size);
  return most;
}

}  // namespace gloam
