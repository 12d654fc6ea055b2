// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "modules/depth_of_field/frame.h"

namespace gloam {

[[nodiscard]] ComputeProgram dof_reset_program();
[[nodiscard]] ComputeProgram dof_bounds_program();
[[nodiscard]] ComputeProgram dof_reach_program(Bokeh bokeh);
[[nodiscard]] ComputeProgram dof_list_program(Bokeh bokeh);

/// A buffer with an item for each tile. size: bytes of an item.
[[nodiscard]] BufferRef dof_tile_buffer(FrameBuilder& frame, const DofInputs& inputs, const char* name,
                                        std::uint64_t size);

/// Finds the circles of each tile.
[[nodiscard]] DofTiles add_dof_bounds_pass(FrameBuilder& frame, const DofInputs& inputs);
/// Lists the tiles in which each later pass runs.
void add_dof_list_passes(FrameBuilder& frame, const DofInputs& inputs, const DofSprites& sprites, DofTiles& tiles);

/// Binds list and entries of a pass over listed tiles (list_api.glsl).
void read_dof_lists(ComputePass& pass, const DofTiles& tiles);
/// Runs over the tiles of a list (GLOAM_DOF_…).
void dispatch_dof_list(ComputePass& pass, const DofTiles& tiles, std::uint32_t list);

}  // namespace gloam
