// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "modules/reflections/frame.h"

namespace gloam {

[[nodiscard]] ComputeProgram proxy_program(const ReflectionKnobs& knobs);

/// Tier 2, merged with tier 1: writes ReflectionFrame::color and surface.
void add_proxy_pass(FrameBuilder& frame, ReflectionFrame& reflections);

}  // namespace gloam
