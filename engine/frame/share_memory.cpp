// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "engine/frame/plan.h"
#include "engine/gpu/image_size.h"

namespace gloam::frame {

namespace {

/// The slot whose size differs least among those that are free at `time` and fit; kNone when there is none.
std::uint32_t find_slot(const Plan& plan, const std::vector<MemorySlot>& slots, std::uint32_t time, std::uint64_t bytes,
                        bool exact) {
  std::uint32_t best = kNone;
  std::uint64_t best_difference = ~std::uint64_t{0};
  for (std::uint32_t s = 0; s < slots.size(); ++s) {
    if (plan.lives[slots[s].resources.back()].last >= time) continue;
    const std::uint64_t size = slots[s].bytes;
    const std::uint64_t difference = size > bytes ? size - bytes : bytes - size;
    if ((exact && difference != 0) || difference >= best_difference) continue;
    best = s;
    best_difference = difference;
  }
  return best;
}

void place(Plan& plan, std::vector<MemorySlot>& slots, std::uint32_t resource, std::uint64_t bytes, bool exact) {
  std::uint32_t slot = find_slot(plan, slots, plan.lives[resource].first, bytes, exact);
  if (slot == kNone) {
    slot = static_cast<std::uint32_t>(slots.size());
    slots.emplace_back();
  }
  slots[slot].resources.push_back(resource);
  slots[slot].bytes = std::max(slots[slot].bytes, bytes);
  plan.lives[resource].slot = slot;
  plan.unshared_bytes += bytes;
}

/// The first access of each resource waits for the resource that had the memory before it.
void chain(Plan& plan, const std::vector<MemorySlot>& slots) {
  for (const MemorySlot& slot : slots) {
    plan.transient_bytes += slot.bytes;
    std::uint32_t before = slot.resources.back();
    for (std::uint32_t resource : slot.resources) {
      plan.barriers[plan.lives[resource].first_barrier].also_before = plan.lives[before].ending;
      before = resource;
    }
  }
}

}  // namespace

void share_memory(const Declaration& declaration, Plan& plan) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t r = 0; r < declaration.resources.size(); ++r) {
    if (!declaration.resources[r].imported && plan.lives[r].first != kNone) order.push_back(r);
  }
  std::ranges::stable_sort(order, {}, [&](std::uint32_t r) { return plan.lives[r].first; });
  for (std::uint32_t r : order) {
    const DeclaredResource& resource = declaration.resources[r];
    if (resource.is_image) {
      place(plan, plan.image_slots, r, gpu::image_bytes(resource.image_desc), false);
    } else {
      place(plan, plan.buffer_slots, r, resource.buffer_desc.size, true);
    }
  }
  chain(plan, plan.image_slots);
  chain(plan, plan.buffer_slots);
}

}  // namespace gloam::frame
