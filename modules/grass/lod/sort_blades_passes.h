// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "modules/grass/frame.h"

namespace gloam {

[[nodiscard]] ComputeProgram grass_keys_program();
[[nodiscard]] ComputeProgram grass_live_program();
/// group_masters: masters of one workgroup of the simulation.
[[nodiscard]] ComputeProgram grass_masters_program(std::uint32_t group_masters);

/// Sorts the blades of the view's patches by distance, and counts those that are drawn.
[[nodiscard]] SortedBlades add_blade_sort_passes(FrameBuilder& frame, const GrassInputs& inputs,
                                                 const GrassStore& store);

/// Lists the masters that the frame must simulate.
[[nodiscard]] MasterList add_master_pass(FrameBuilder& frame, const GrassInputs& inputs, const GrassStore& store,
                                         const SortedBlades& sorted);

}  // namespace gloam
