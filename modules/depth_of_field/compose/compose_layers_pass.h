// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "modules/depth_of_field/frame.h"

namespace gloam {

/// in_turn: on a device that runs the threads of a workgroup in turn, where a thread goes through eight rows of texels.
[[nodiscard]] ComputeProgram dof_compose_program(std::uint32_t scale, bool near, bool in_turn);

/// Lays the blurred layers over LitOutput, in place.
void add_dof_compose_pass(FrameBuilder& frame, const DofFrame& dof, const DofLayers& blurred);

}  // namespace gloam
