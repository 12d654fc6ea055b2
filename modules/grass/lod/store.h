// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "modules/grass/field/grow.h"
#include "modules/grass/frame.h"

namespace gloam {

/// Patches of one surface in a field.
struct PlantedPatches {
  std::uint64_t number = 0;  ///< GrassPlanting::number
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// Contents of the buffers of one world after the last frame that was submitted.
struct GrassStoreState {
  GrassResidency residency;
  std::uint64_t field = 0;                ///< version of the field
  std::vector<PlantedPatches> plantings;  ///< of the field
  std::uint32_t slot_masters = 0;         ///< masters for which a slot has room
  std::uint32_t generation = 0;           ///< of the buffers; a new one when they grow
  std::uint32_t restarts = 0;             ///< StepClock::restarts of the knots
};

/// States of the worlds of a module. A frame works on a copy, which takes effect when it is submitted.
class GrassStoreStates {
 public:
  /// The state that the world's frame begins with, or that an earlier view of the frame has left. Call it while passes
  /// are declared.
  [[nodiscard]] GrassStoreState& of_frame(FrameBuilder& frame, std::uint64_t world);
  /// Patches of the world's last view that found no slot.
  [[nodiscard]] std::uint32_t left_out(std::uint64_t world) const;
  void clear() { worlds_.clear(); }

 private:
  struct World {
    GrassStoreState submitted;
    GrassStoreState pending;
    std::uint64_t device_frame = ~std::uint64_t{0};  ///< of `pending`
  };
  std::map<std::uint64_t, World> worlds_;
};

/// The field that a store holds blades of.
struct GrassStoreInput {
  std::span<const GrassPatch> patches;
  std::span<const GrassPlanting> plantings;      ///< of the patches
  std::span<const shaders::GrassBladeRow> rows;  ///< 256 per patch
  std::uint64_t field = 0;                       ///< version of the patches
  std::uint64_t row_version = 0;
  std::uint32_t slot_masters = 0;  ///< most masters of a patch
  std::uint32_t restarts = 0;      ///< StepClock::restarts; knots of another one are forgotten
};

/// Gives the view's patches slots, grows the buffers, and adds the passes that upload the rows of new patches and clear
/// their stamps. If the field is another version, patches of surfaces that were not planted anew keep their knots.
[[nodiscard]] StoredPatches add_store_passes(FrameBuilder& frame, const GrassStoreInput& input,
                                             std::span<const VisiblePatch> visible, GrassStoreState& state);

}  // namespace gloam
