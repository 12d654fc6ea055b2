// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "engine/render/declare/draw_pass.h"
#include "modules/reflections/frame.h"

namespace gloam {

/// screen_space: whether hits are looked up again where mirrors are smooth. bumpy: for tiles with slanted normals.
/// centered: texels stand for the middles of blocks, as ReflectionConstants::centered says.
[[nodiscard]] ComputeProgram composite_program(bool screen_space, bool bumpy, bool centered);

/// Adds the mirrored images to LitOutput, in the tiles that hold a mirror surface: upscaled, with bent lookup, sharp
/// hits and fog. bends: whether lookups follow the normals of pixels (ReflectionKnobs::bends()).
void add_composite_pass(FrameBuilder& frame, const ReflectionUniforms& uniforms, const MirrorSurfaces& surfaces,
                        const ScreenSpaceHits& hits, const MirroredLight& light, bool bends);

/// Adds traced reflections to LitOutput, which lacks its specular ambient term. traced: rgba32f, of the view's size.
void add_traced_light_pass(FrameBuilder& frame, ImageRef traced);

}  // namespace gloam
