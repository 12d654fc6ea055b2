// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "modules/reflections/frame.h"

namespace gloam {

[[nodiscard]] ComputeProgram temporal_program();

/// Replaces ReflectionFrame::color by its accumulation over frames, which the view keeps.
void add_temporal_pass(FrameBuilder& frame, ReflectionFrame& reflections);

}  // namespace gloam
