// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "modules/depth_of_field/frame.h"

namespace gloam {

/// kind: GLOAM_DOF_COMPOSE_ONE (+ 1 for levels after the first), GLOAM_DOF_COMPOSE_TWO and so on.
[[nodiscard]] ComputeProgram dof_compose_program(Bokeh bokeh, std::uint32_t kind, bool full_resolution,
                                                 bool threads_in_turn);

/// Lays the gathered layers and the sprites over LitOutput, in place.
void add_dof_compose_pass(FrameBuilder& frame, const DofFrame& dof, const DofLayers& gathered,
                          const DofSprites& sprites);

}  // namespace gloam
