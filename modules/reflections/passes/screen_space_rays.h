// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "modules/reflections/frame.h"

namespace gloam {

[[nodiscard]] ComputeProgram screen_space_program(const ReflectionKnobs& knobs, bool blended,
                                                  const gpu::SpecConstants& probes);

/// Tier 1: follows a mirrored ray from each mirror surface through the depth image, and through BlendedLayer if there
/// is one.
[[nodiscard]] ScreenSpaceHits add_screen_space_pass(FrameBuilder& frame, const ReflectionKnobs& knobs,
                                                    const ReflectionUniforms& uniforms, const MirrorTiles& tiles);

}  // namespace gloam
