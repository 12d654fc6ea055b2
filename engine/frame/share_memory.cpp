// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>
#include <vector>

#include "engine/frame/plan.h"
#include "engine/gpu/image_size.h"

namespace gloam::frame {

namespace {

/// Of the slots that are free at `time`, the one closest in size to `bytes`; kNone if none is free. exact: only slots
/// of equal size.
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

/// Collects the accesses that the next user of a slot's memory must wait for: the accesses of the last user, and of
/// larger earlier users, whose memory the last user covers only in part.
class Predecessors {
 public:
  void add(std::uint64_t bytes, gpu::AccessMask ending) {
    while (!stack_.empty() && stack_.back().first <= bytes) stack_.pop_back();
    stack_.emplace_back(bytes, ending);
  }
  [[nodiscard]] gpu::AccessMask endings() const {
    gpu::AccessMask all = 0;
    for (const auto& [bytes, ending] : stack_) all |= ending;
    return all;
  }

 private:
  std::vector<std::pair<std::uint64_t, gpu::AccessMask>> stack_;  ///< {bytes, ending}, sizes decreasing
};

std::uint64_t bytes_of(const DeclaredResource& resource) {
  return resource.is_image ? gpu::image_bytes(resource.image_desc) : resource.buffer_desc.size;
}

/// Makes the first barriers of each resource, which discard its contents, wait for the earlier users of its memory,
/// including the users in the previous frame.
void chain(const Declaration& declaration, Plan& plan, const std::vector<MemorySlot>& slots,
           std::vector<gpu::AccessMask>& earlier) {
  for (const MemorySlot& slot : slots) {
    plan.transient_bytes += slot.bytes;
    Predecessors predecessors;
    for (const bool this_frame : {false, true}) {
      for (std::uint32_t resource : slot.resources) {
        if (this_frame) earlier[resource] = predecessors.endings();
        predecessors.add(bytes_of(declaration.resources[resource]), plan.lives[resource].ending);
      }
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
    place(plan, resource.is_image ? plan.image_slots : plan.buffer_slots, r, bytes_of(resource), !resource.is_image);
  }
  std::vector<gpu::AccessMask> earlier(declaration.resources.size(), 0);
  chain(declaration, plan, plan.image_slots, earlier);
  chain(declaration, plan, plan.buffer_slots, earlier);
  for (PlannedBarrier& barrier : plan.barriers) {
    const bool discards = barrier.before == gpu::Access::none && !declaration.resources[barrier.resource].imported;
    if (discards) barrier.also_before = earlier[barrier.resource];
  }
}

}  // namespace gloam::frame
