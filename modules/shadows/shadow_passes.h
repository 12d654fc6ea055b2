// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/frame_builder.h"
#include "modules/shadows/final_lists/reuse.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/maps/state.h"

namespace gloam {

/// The knobs of the frame, with the side that the view's atlas has in it.
[[nodiscard]] ShadowKnobs knobs_of(const FrameBuilder& frame);

/// Adds the passes that update the view's shadow maps, and the passes of its final lists if can_generate() and
/// generate_pipelines_ready() are true. Puts ShadowsOutputs on the board. Exposes the image "shadow_atlas", whose
/// texels outside of faces are undefined. On an error the frame is given up.
void add_shadow_passes(FrameBuilder& frame, ShadowStates& states, ListReuse& reuse);

}  // namespace gloam
