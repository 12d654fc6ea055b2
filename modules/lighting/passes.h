// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/frame_builder.h"

namespace gloam {

/// Shades the surfaces in the geometry buffer and fills the sky; writes LitOutput.
void add_deferred_pass(FrameBuilder& frame);

/// Draws blended surfaces over LitOutput, back to front. Does nothing if there are none.
void add_forward_pass(FrameBuilder& frame);

/// Maps LitOutput to TargetOutput. Meters first, in the first frame of a camera without a set exposure.
void add_tone_map_passes(FrameBuilder& frame);

}  // namespace gloam
