// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/frame_builder.h"

namespace gloam {

/// PassPhase::post: spreads the view's light, and puts ScatteredLight on the board. share: > 0. lines: of kGlareLines,
/// > 0.
void add_glare_passes(FrameBuilder& frame, float share, std::uint32_t lines);

/// After tone mapping: LitOutput becomes the light as it is shown, with ScatteredLight, in another image. The frame
/// graph leaves the pass out if nothing reads that image.
void add_shown_light_pass(FrameBuilder& frame);

/// Appends the pipelines that add_glare_passes() wants.
void list_glare_pipelines(PipelineList& list);

}  // namespace gloam
