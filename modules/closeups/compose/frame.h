// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/render/frame_builder.h"
#include "modules/closeups/pairs/views.h"

namespace gloam {

/// What a frame does with its view's pairs. On the board from PassPhase::announce on, when it draws any.
struct CloseupFrame {
  std::vector<CloseupView> pairs;  ///< that have maps of their own, in the order of CloseupViews
  std::uint32_t skipped = 0;       ///< CloseupViews::skipped, and those whose standard faces found no room for copies
  bool copies = false;             ///< standard maps are looked at: copies of them will hold the subjects
  OverlayPlan overlay;             ///< those copies
};

/// Whether something looks at the view's standard maps: forward-lit surfaces, or tiles without a final list.
/// `complete`: FinalLists::always_complete as far as it is known.
[[nodiscard]] bool standard_maps_are_seen(const FrameBuilder& frame, std::optional<bool> complete);

/// complete: as it was in the view's last frame.
[[nodiscard]] CloseupFrame plan_closeup_frame(const FrameBuilder& frame, std::optional<bool> complete);

/// The same pairs, with what copies of standard faces find room: they turned out to be needed after all.
void add_late_copies(const FrameBuilder& frame, CloseupFrame& closeups);

}  // namespace gloam
