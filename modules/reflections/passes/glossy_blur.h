// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "modules/reflections/frame.h"

namespace gloam {

/// direct: without shared memory, in the listed tiles only; for devices that run threads in turn.
[[nodiscard]] ComputeProgram dilate_program(bool columns, bool direct);
[[nodiscard]] ComputeProgram blur_program(bool columns, bool direct);

/// The light, blurred by the spread of its surface, dilated or as it is.
[[nodiscard]] MirroredLight add_glossy_passes(FrameBuilder& frame, const ReflectionUniforms& uniforms,
                                              const MirrorTiles& tiles, const MirroredLight& light, bool dilate);

}  // namespace gloam
