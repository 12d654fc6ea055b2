// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/frame_builder.h"
#include "shaders/lighting/lighting_shared.h"

namespace gloam {

/// Frames that the picture of a view at rest is the mean of.
inline constexpr std::uint32_t kAccumulatedFrames = GLOAM_ACCUMULATED_FRAMES;

/// Whether the picture of this view is accumulated over frames. It always is if it is larger than the view. Other views
/// that are not jittered are antialiased by lighting.antialiasing=smaa instead (antialiases).
[[nodiscard]] bool accumulates(FrameBuilder& frame);

/// Accumulates the displayed light at the size of TargetOutput, and writes the picture there. shown: of kShownFormat
/// and the view's size; its alpha is the share of the light that has no motion. dither: see add_antialiasing_passes.
void add_temporal_passes(FrameBuilder& frame, ImageRef shown, bool dither);

}  // namespace gloam
