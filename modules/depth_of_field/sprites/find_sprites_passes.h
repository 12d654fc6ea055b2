// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "modules/depth_of_field/frame.h"

namespace gloam {

[[nodiscard]] ComputeProgram dof_find_sprites_program();
[[nodiscard]] ComputeProgram dof_reach_sprites_program();

/// Finds the pixels of LitOutput that are drawn as sprites, and lists those that reach each tile. Counts them in the
/// lists.
[[nodiscard]] DofSprites add_dof_sprite_passes(FrameBuilder& frame, DofFrame& dof);

}  // namespace gloam
