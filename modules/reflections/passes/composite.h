// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "engine/render/declare/compute_pass.h"
#include "engine/render/declare/draw_pass.h"
#include "modules/reflections/frame.h"

namespace gloam {

/// mirror: whether there are reflection images. probes: number of captured probes. tiles: draws the tiles with a mirror
/// surface, or without `mirror` the others; otherwise the whole picture. traced: traced radiance in place of all tiers.
[[nodiscard]] DrawProgram composite_program(bool mirror, std::size_t probes, bool tiles, bool traced = false);

[[nodiscard]] ComputeProgram sharpen_program(bool screen_space);

/// Writes ReflectionFrame::upscaled in the listed tiles.
void add_sharpen_pass(FrameBuilder& frame, ReflectionFrame& reflections);

/// Adds the specular reflection of the surroundings to LitOutput.
void add_composite_pass(FrameBuilder& frame, const ReflectionFrame& reflections);

}  // namespace gloam
