// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/lod/residency.h"

#include <algorithm>
#include <bit>

namespace gloam {

void GrassResidency::grow(std::size_t needed, std::uint32_t most) {
  const std::size_t wanted = std::bit_ceil(std::max<std::size_t>(needed, kFewest));
  const std::size_t count = std::min<std::size_t>(wanted, most);
  if (count > slots_.size()) slots_.resize(count);
}

void GrassResidency::clear_patches() {
  slots_.assign(slots_.size(), {});
  slot_of_.clear();
}

std::vector<ResidentPatch> GrassResidency::place(std::span<const VisiblePatch> patches, std::uint64_t frame,
                                                 std::uint64_t row_version, std::uint32_t most) {
  std::vector<ResidentPatch> placed;
  placed.reserve(patches.size());
  std::size_t others = 0;  // slots that earlier views of the frame use for other patches
  for (const Slot& slot : slots_) others += slot.patch != ~0u && slot.used == frame ? 1 : 0;
  for (const VisiblePatch& visible : patches) {
    const auto found = slot_of_.find(visible.patch);
    if (found == slot_of_.end()) continue;
    Slot& slot = slots_[found->second];
    others -= slot.used == frame ? 1 : 0;
    slot.used = frame;
  }
  grow(others + patches.size(), most);

  std::vector<std::uint32_t> free;  // the slot unused for the longest last
  for (std::uint32_t i = 0; i < slots_.size(); ++i)
    if (slots_[i].patch == ~0u || slots_[i].used != frame) free.push_back(i);
  std::ranges::sort(free, [&](std::uint32_t a, std::uint32_t b) {
    const std::uint64_t used_a = slots_[a].patch == ~0u ? 0 : slots_[a].used + 1;
    const std::uint64_t used_b = slots_[b].patch == ~0u ? 0 : slots_[b].used + 1;
    return used_a != used_b ? used_a > used_b : a > b;
  });
  left_out_ = 0;
  for (const VisiblePatch& visible : patches) {
    if (const auto found = slot_of_.find(visible.patch); found != slot_of_.end()) {
      Slot& slot = slots_[found->second];
      placed.push_back({visible.patch, found->second, false, slot.rows != row_version});
      slot.rows = row_version;
      continue;
    }
    if (free.empty()) {
      ++left_out_;
      continue;
    }
    const std::uint32_t slot = free.back();
    free.pop_back();
    if (slots_[slot].patch != ~0u) slot_of_.erase(slots_[slot].patch);
    slots_[slot] = {visible.patch, frame, row_version};
    slot_of_[visible.patch] = slot;
    placed.push_back({visible.patch, slot, true, true});
  }
  return placed;
}

}  // namespace gloam
