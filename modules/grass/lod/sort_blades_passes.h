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

/// Sorts the blades of the view's patches by distance, counts those that are drawn, and lists the masters that the
/// frame must simulate. Sets GrassFrame::blades, bins, draws, dispatch, masters and store.stamps.
void add_grass_lod_passes(FrameBuilder& frame, GrassFrame& grass);

}  // namespace gloam
