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

/// Returns an rgba16f image of the view's size: in the listed tiles the light with bent lookup, sharp hits and fog.
[[nodiscard]] ImageRef add_sharpen_pass(FrameBuilder& frame, const ReflectionUniforms& uniforms,
                                        const MirrorTiles& tiles, const ScreenSpaceHits& hits,
                                        const MirroredLight& light);

/// Reflections of a view for the composite.
struct CompositeInputs {
  MirrorTiles tiles;  ///< if `upscaled` is not null
  ImageRef upscaled;  ///< add_sharpen_pass(); null: no surface shows tiers 1 and 2
  ProbeInputs probes;
  ImageRef traced;  ///< rgba32f, of the view's size: takes the place of all tiers; null: none
};

/// Adds the specular reflection of the surroundings to LitOutput.
void add_composite_pass(FrameBuilder& frame, const ReflectionUniforms& uniforms, const CompositeInputs& inputs);

}  // namespace gloam
