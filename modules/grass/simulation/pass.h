// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "modules/grass/frame.h"

namespace gloam {

/// threads: 32, 64 or 128 in a workgroup.
[[nodiscard]] ComputeProgram grass_simulation_program(std::uint32_t threads);

/// Runs the steps of the listed masters. groups: size of the dispatch; null: the GPU's own (GrassFrame::dispatch).
void add_simulation_pass(FrameBuilder& frame, GrassFrame& grass, const std::uint32_t* groups);

}  // namespace gloam
