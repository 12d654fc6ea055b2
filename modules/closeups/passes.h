// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"
#include "modules/closeups/knobs.h"
#include "modules/closeups/pairs/views.h"

namespace gloam {

/// Casters that pairs draw into maps of their own.
[[nodiscard]] WithheldCasters withheld_casters(std::span<const CloseupView> pairs, const CloseupSubjects& subjects);

/// Whether the pipelines of the frame's pairs are there; those that are not are made in the background.
[[nodiscard]] bool closeup_pipelines_ready(const FrameBuilder& frame, const CloseupKnobs& knobs);

/// Draws the pairs of the CloseupFrame on the board one batch after the other into one map, and takes what their
/// subjects keep of the light from the final lists on the board; where standard maps are looked at, copies of those
/// hold the subjects too. Nothing in a frame without final lists.
[[nodiscard]] Status add_closeup_passes(FrameBuilder& frame, const CloseupKnobs& knobs);

}  // namespace gloam
