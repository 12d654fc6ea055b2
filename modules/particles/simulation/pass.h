// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "modules/particles/frame.h"

namespace gloam {

[[nodiscard]] ComputeProgram particle_simulation_program();

/// Computes the state and the sort key of each particle of the view's emitters.
void add_particle_simulation_pass(FrameBuilder& frame, ParticlesFrame& particles);

}  // namespace gloam
