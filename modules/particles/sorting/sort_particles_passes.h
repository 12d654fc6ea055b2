// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/declare/compute_pass.h"
#include "modules/particles/frame.h"

namespace gloam {

/// The programs of the passes.
[[nodiscard]] std::vector<ComputeProgram> particle_sort_programs(bool threads_in_turn);

/// Sorts the particles by their keys, and counts those that are drawn.
void add_particle_sort_passes(FrameBuilder& frame, ParticlesFrame& particles);

}  // namespace gloam
