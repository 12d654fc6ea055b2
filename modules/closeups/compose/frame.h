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
  /// By pair: 1 if a surface that is shaded from the light's standard maps may be in the subject's shadow, so that the
  /// overlay must hold the subject.
  std::vector<std::uint8_t> in_overlay;
  std::uint32_t skipped = 0;  ///< CloseupViews::skipped, plus pairs whose overlay found no room in the atlas
  OverlayPlan overlay;        ///< the faces of that overlay
};

/// Whether fallback tiles may read the view's standard maps. `complete`: FinalLists::always_complete, if known.
[[nodiscard]] bool may_have_fallback_tiles(std::optional<bool> complete);

/// Plans the view's close-up pairs for this frame. `complete`: FinalLists::always_complete of the view's last frame, if
/// known.
[[nodiscard]] CloseupFrame plan_closeup_frame(const FrameBuilder& frame, std::optional<bool> complete);

/// Adds all pairs of `closeups` to the overlay. For a frame that turns out to have fallback tiles only after
/// PassPhase::announce.
void add_late_copies(const FrameBuilder& frame, CloseupFrame& closeups);

}  // namespace gloam
