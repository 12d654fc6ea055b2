// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "modules/depth_of_field/frame.h"

namespace gloam {

/// more: of tiles with sprites or pixels before the focus. fine: of level 0.
[[nodiscard]] ComputeProgram dof_prefilter_program(Bokeh bokeh, bool more, bool fine, bool threads_in_turn);
/// The form follows from knob and device.
[[nodiscard]] ComputeProgram dof_gather_program(DofKnobs::Cache cache, Bokeh bokeh, bool near, bool threads_in_turn);

/// Sets how many tiles share a workgroup of these passes.
void set_dof_workgroups(DofInputs& inputs);

/// Makes the layers from LitOutput.
[[nodiscard]] DofLayers add_dof_prefilter_pass(FrameBuilder& frame, const DofFrame& dof, const DofSprites& sprites);
/// The layers, blurred.
[[nodiscard]] DofLayers add_dof_gather_passes(FrameBuilder& frame, const DofFrame& dof, const DofLayers& layers);

}  // namespace gloam
