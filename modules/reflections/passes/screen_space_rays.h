// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "modules/reflections/frame.h"

namespace gloam {

[[nodiscard]] ComputeProgram screen_space_program(const ReflectionKnobs& knobs);

/// Tier 1: writes ReflectionFrame::ssr_color and ssr_distance.
void add_screen_space_pass(FrameBuilder& frame, ReflectionFrame& reflections);

}  // namespace gloam
