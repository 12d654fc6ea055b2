// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/frame_builder.h"

namespace gloam {

/// Whether the picture of this view is accumulated over frames. Views that are not jittered are antialiased by
/// lighting.antialiasing=smaa instead (antialiases).
[[nodiscard]] bool accumulates(const FrameBuilder& frame);

/// Accumulates the displayed light and writes the picture to TargetOutput. shown: of kShownFormat and the view's size;
/// its alpha is the share of the light that has no motion. dither: see add_antialiasing_passes.
void add_temporal_passes(FrameBuilder& frame, ImageRef shown, bool dither);

}  // namespace gloam
