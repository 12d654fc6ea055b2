// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/render/frame_builder.h"
#include "modules/closeups/knobs.h"
#include "modules/closeups/pairs/views.h"

namespace gloam {

/// The casters that pairs draw into the close-up map, by light.
[[nodiscard]] WithheldCasters withheld_casters(std::span<const CloseupView> pairs, const CloseupSubjects& subjects);

/// Whether the pipelines for close-up pairs are ready. Missing ones are built in the background.
[[nodiscard]] bool closeup_pipelines_ready(const FrameBuilder& frame, const CloseupKnobs& knobs);

/// For the pairs of the CloseupFrame on the board: draws their maps, unless those of an earlier frame still hold, and
/// lowers the visibilities in the final lists on the board by what the subjects hide. Also adds the subjects of pairs
/// with CloseupFrame::in_overlay to the overlay. Does nothing in a frame without final lists. Returns the number of
/// maps that were drawn.
std::uint32_t add_closeup_passes(FrameBuilder& frame, const CloseupKnobs& knobs);

}  // namespace gloam
