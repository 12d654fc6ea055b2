// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>
#include <vector>

#include "engine/frame/planning/plan.h"
#include "engine/gpu/image_size.h"

namespace gloam::frame {

namespace {

Result<gpu::MemoryNeeds> needs_of(const gpu::Device* device, const gpu::ImageDesc& desc) {
  if (device != nullptr) return device->memory_needs(desc);
  return gpu::MemoryNeeds{.size = gpu::image_bytes(desc), .types = 1};
}
Result<gpu::MemoryNeeds> needs_of(const gpu::Device* device, const gpu::BufferDesc& desc) {
  if (device != nullptr) return device->memory_needs(desc);
  return gpu::MemoryNeeds{.size = desc.size, .types = 1};
}

class MemorySharer {
 public:
  MemorySharer(const Declaration& declaration, const gpu::Device* device, Plan& plan)
      : declaration_(declaration), device_(device), plan_(plan), needs_(declaration.resources.size()) {}

  /// Assigns a transient to a slot. Transients come in order of their first use.
  [[nodiscard]] Status place(std::uint32_t resource) {
    const bool image = declaration_.resources[resource].is_image;
    Result<gpu::MemoryNeeds> needs = needs_of_transient(resource);
    if (!needs.ok()) return needs.error();
    needs_[resource] = *needs;
    std::vector<MemorySlot>& slots = image ? plan_.image_slots : plan_.buffer_slots;
    std::uint32_t slot = find_slot(slots, resource);
    if (slot == kNone) {
      slot = static_cast<std::uint32_t>(slots.size());
      slots.emplace_back();
    }
    slots[slot].resources.push_back(resource);
    if (needs->size > slots[slot].bytes) slots[slot].largest = resource;
    slots[slot].bytes = std::max(slots[slot].bytes, needs->size);
    plan_.lives[resource].slot = slot;
    plan_.unshared_bytes += needs->size;
    plan_.endings |= plan_.lives[resource].ending;
    return {};
  }

  /// Gives every slot its place in the heap of its kind of memory.
  [[nodiscard]] Status place_slots() {
    for (MemorySlot& slot : plan_.image_slots) {
      gpu::MemoryNeeds needs{.size = slot.bytes, .types = needs_[slot.resources.front()].types};
      for (std::uint32_t r : slot.resources) needs.alignment = std::max(needs.alignment, needs_[r].alignment);
      place_slot(slot, needs);
    }
    for (MemorySlot& slot : plan_.buffer_slots) {
      const Result<gpu::MemoryNeeds> needs = needs_of(device_, buffer_desc_of(declaration_, plan_, slot));
      if (!needs.ok()) return needs.error();
      place_slot(slot, *needs);
    }
    return {};
  }

  /// Makes the first barriers of each transient, which discard its contents, wait for the earlier users of its memory,
  /// including the users in the previous frame.
  void chain() {
    std::vector<gpu::AccessMask> earlier(declaration_.resources.size(), 0);
    chain(plan_.image_slots, earlier);
    chain(plan_.buffer_slots, earlier);
    for (PlannedBarrier& barrier : plan_.barriers) {
      const bool discards = barrier.before == gpu::Access::none && !declaration_.resources[barrier.resource].imported;
      if (discards) barrier.also_before = earlier[barrier.resource];
    }
  }

 private:
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

  /// Bytes that barriers of the resource act on: without the padding at the end of its memory.
  [[nodiscard]] std::uint64_t content_bytes(std::uint32_t resource) const {
    const DeclaredResource& declared = declaration_.resources[resource];
    return declared.is_image ? gpu::image_bytes(declared.image_desc) : declared.buffer_desc.size;
  }

  [[nodiscard]] Result<gpu::MemoryNeeds> needs_of_transient(std::uint32_t resource) const {
    if (declaration_.resources[resource].is_image) {
      return needs_of(device_, image_desc_of(declaration_, plan_, resource));
    }
    return needs_of(device_, buffer_desc_of(declaration_, plan_, {.resources = {resource}}));
  }

  /// Of the slots that are free when the resource is first used, the one closest in size; kNone if none is free. Images
  /// share slots of their kind of memory, buffers those of equal size.
  [[nodiscard]] std::uint32_t find_slot(const std::vector<MemorySlot>& slots, std::uint32_t resource) const {
    const DeclaredResource& declared = declaration_.resources[resource];
    const std::uint64_t bytes = needs_[resource].size;
    std::uint32_t best = kNone;
    std::uint64_t best_difference = ~std::uint64_t{0};
    for (std::uint32_t s = 0; s < slots.size(); ++s) {
      const std::uint32_t last = slots[s].resources.back();
      if (plan_.lives[last].last >= plan_.lives[resource].first || needs_[last].types != needs_[resource].types)
        continue;
      const bool fits = declared.is_image || declaration_.resources[last].buffer_desc.size == declared.buffer_desc.size;
      const std::uint64_t size = slots[s].bytes;
      const std::uint64_t difference = size > bytes ? size - bytes : bytes - size;
      if (!fits || difference >= best_difference) continue;
      best = s;
      best_difference = difference;
    }
    return best;
  }

  void place_slot(MemorySlot& slot, const gpu::MemoryNeeds& needs) {
    auto heap = std::ranges::find(plan_.heaps, needs.types, &HeapNeed::types);
    if (heap == plan_.heaps.end()) heap = plan_.heaps.insert(heap, HeapNeed{.types = needs.types});
    slot.bytes = needs.size;
    slot.heap = static_cast<std::uint32_t>(heap - plan_.heaps.begin());
    slot.offset = (heap->bytes + needs.alignment - 1) & ~(needs.alignment - 1);
    heap->bytes = slot.offset + slot.bytes;
    plan_.transient_bytes += slot.bytes;
  }

  void chain(const std::vector<MemorySlot>& slots, std::vector<gpu::AccessMask>& earlier) const {
    for (const MemorySlot& slot : slots) {
      Predecessors predecessors;
      for (const bool this_frame : {false, true}) {
        for (std::uint32_t resource : slot.resources) {
          if (this_frame) earlier[resource] = predecessors.endings();
          predecessors.add(content_bytes(resource), plan_.lives[resource].ending);
        }
      }
    }
  }

  const Declaration& declaration_;
  const gpu::Device* device_;
  Plan& plan_;
  std::vector<gpu::MemoryNeeds> needs_;  ///< by resource
};

}  // namespace

gpu::ImageDesc image_desc_of(const Declaration& declaration, const Plan& plan, std::uint32_t resource) {
  gpu::ImageDesc desc = declaration.resources[resource].image_desc;
  desc.usage = desc.usage | static_cast<gpu::ImageUsage>(plan.lives[resource].image_usage);
  return desc;
}

gpu::BufferDesc buffer_desc_of(const Declaration& declaration, const Plan& plan, const MemorySlot& slot) {
  gpu::BufferDesc desc = declaration.resources[slot.resources.front()].buffer_desc;
  for (std::uint32_t r : slot.resources) {
    desc.usage = desc.usage | declaration.resources[r].buffer_desc.usage |
                 static_cast<gpu::BufferUsage>(plan.lives[r].buffer_usage);
  }
  return desc;
}

Status share_memory(const Declaration& declaration, const gpu::Device* device, Plan& plan) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t r = 0; r < declaration.resources.size(); ++r) {
    if (!declaration.resources[r].imported && plan.lives[r].first != kNone) order.push_back(r);
  }
  std::ranges::stable_sort(order, {}, [&](std::uint32_t r) { return plan.lives[r].first; });
  MemorySharer sharer(declaration, device, plan);
  for (std::uint32_t r : order) GLOAM_TRY(sharer.place(r));
  GLOAM_TRY(sharer.place_slots());
  sharer.chain();
  return {};
}

}  // namespace gloam::frame
