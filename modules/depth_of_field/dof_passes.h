// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/frame_builder.h"
#include "modules/depth_of_field/frame.h"

namespace gloam {

/// PassPhase::post: blurs LitOutput by the lens of the view's camera, and leaves DofFrame on the board.
void add_dof_passes(FrameBuilder& frame, const DepthOfField& values, const Lens& lens);

/// Pipelines that add_dof_passes() uses with these knobs.
void list_dof_pipelines(const DofKnobs& knobs, bool threads_in_turn, PipelineList& list);

}  // namespace gloam
