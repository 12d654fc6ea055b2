// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// The GPU holds rows and knots of the patches that views have shown lately, and of no others: memory follows what is
// live, not the size of the field.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "modules/grass/lod/visible_patches.h"

namespace gloam {

/// One patch of a frame that has a slot.
struct ResidentPatch {
  std::uint32_t patch = 0;  ///< index in the field
  std::uint32_t slot = 0;
  bool fresh = false;       ///< the slot held another patch or nothing: stamps must be cleared
  bool stale_rows = false;  ///< rows must be uploaded; true if fresh
};

/// Slots of patches in the buffers of one world.
class GrassResidency {
 public:
  /// Slots of the first frame; the number grows by doubling up to `most`.
  static constexpr std::uint32_t kFewest = 64;

  /// Gives every patch a slot, the nearest first. Patches that were not used in `frame` lose theirs if slots are short,
  /// those unused for the longest first. row_version: of all rows. most: slots that the buffers can have. Patches
  /// without a slot, the farthest, are left out and counted.
  [[nodiscard]] std::vector<ResidentPatch> place(std::span<const VisiblePatch> patches, std::uint64_t frame,
                                                 std::uint64_t row_version, std::uint32_t most);
  /// Forgets all slots; the next frame starts with none.
  void clear() { *this = GrassResidency(); }
  /// Forgets the patches; the slots stay.
  void clear_patches();
  /// Gives every patch that has a slot its index in another field: number_of(patch), or ~0u to forget the patch.
  template <class NumberOf>
  void renumber(const NumberOf& number_of) {
    slot_of_.clear();
    for (std::uint32_t i = 0; i < slots_.size(); ++i) {
      if (slots_[i].patch == ~0u) continue;
      const std::uint32_t patch = number_of(slots_[i].patch);
      if (patch == ~0u)
        slots_[i] = {};
      else
        slot_of_[slots_[i].patch = patch] = i;
    }
  }

  [[nodiscard]] std::uint32_t capacity() const { return static_cast<std::uint32_t>(slots_.size()); }
  [[nodiscard]] std::uint32_t left_out() const { return left_out_; }  ///< of the last call

 private:
  struct Slot {
    std::uint32_t patch = ~0u;
    std::uint64_t used = 0;  ///< newest frame that used it
    std::uint64_t rows = 0;  ///< version of the rows it holds
  };
  void grow(std::size_t needed, std::uint32_t most);

  std::vector<Slot> slots_;
  std::unordered_map<std::uint32_t, std::uint32_t> slot_of_;  ///< by patch
  std::uint32_t left_out_ = 0;
};

}  // namespace gloam
