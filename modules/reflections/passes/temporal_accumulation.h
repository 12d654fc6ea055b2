// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/declare/compute_pass.h"
#include "modules/reflections/frame.h"

namespace gloam {

[[nodiscard]] ComputeProgram temporal_program();

/// The light, accumulated over frames in an image that the view keeps. It begins anew after camera cuts and with other
/// light scales, knobs and captures (ReflectionCaptures::version).
[[nodiscard]] MirroredLight add_temporal_pass(FrameBuilder& frame, const ReflectionUniforms& uniforms,
                                              const MirrorTiles& tiles, const MirroredLight& light,
                                              const ReflectionKnobs& knobs, std::uint64_t captures);

}  // namespace gloam
