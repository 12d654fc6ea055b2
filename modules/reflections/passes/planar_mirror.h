// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "modules/reflections/frame.h"

namespace gloam {

[[nodiscard]] ComputeProgram planar_program(const ReflectionKnobs& knobs);

/// Sets ReflectionFrame::planar, if a companion of the view has drawn the mirrored scene in this frame.
void find_planar_mirror(FrameBuilder& frame, ReflectionFrame& reflections);

/// With ReflectionFrame::planar: writes ReflectionFrame::color and ReflectionFrame::surface from the companion's
/// picture, in place of screen space and proxies.
void add_planar_pass(FrameBuilder& frame, ReflectionFrame& reflections);

}  // namespace gloam
