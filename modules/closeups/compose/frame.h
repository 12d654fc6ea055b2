// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
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

/// The reservation for the umbra ranges of these pairs, so that no tile in which a subject hides light becomes a
/// fallback tile; none if there is no room for it.
[[nodiscard]] std::optional<ReservedTiles> reserve_umbra(const FrameBuilder& frame, std::span<const CloseupView> pairs);

/// Plans the view's close-up pairs for this frame. reserved: their umbra ranges are reserved; otherwise fallback tiles
/// may need all pairs in the overlay.
[[nodiscard]] CloseupFrame plan_closeup_frame(const FrameBuilder& frame, bool reserved);

}  // namespace gloam
