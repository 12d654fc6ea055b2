// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/render/frame_builder.h"
#include "modules/closeups/pairs/views.h"

namespace gloam {

/// The close-up pairs of a frame. On the board from PassPhase::announce on, in frames that draw close-ups.
struct CloseupFrame {
  std::vector<CloseupView> pairs;  ///< pairs with their own map, in the order of CloseupViews
  std::uint32_t skipped = 0;       ///< CloseupViews::skipped, plus pairs whose overlay found no room in the atlas
  bool copies = false;             ///< standard maps are read in this frame, so an overlay holds the subjects
  OverlayPlan overlay;             ///< the faces of that overlay
};

/// Whether the frame reads the view's standard maps: for forward-lit surfaces or fallback tiles. `complete`:
/// FinalLists::always_complete, if known.
[[nodiscard]] bool standard_maps_are_seen(const FrameBuilder& frame, std::optional<bool> complete);

/// Plans the view's close-up pairs for this frame. `complete`: FinalLists::always_complete of the view's last frame, if
/// known.
[[nodiscard]] CloseupFrame plan_closeup_frame(const FrameBuilder& frame, std::optional<bool> complete);

/// Plans the overlay for the pairs of `closeups`. For a frame whose need for an overlay becomes known only after
/// PassPhase::announce.
void add_late_copies(const FrameBuilder& frame, CloseupFrame& closeups);

}  // namespace gloam
