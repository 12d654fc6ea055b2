// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/render/declare/draw_pass.h"
#include "modules/particles/frame.h"
#include "modules/particles/lighting/light_sprites_pass.h"

namespace gloam {

/// Indices of the two triangles of each sprite of an instance.
[[nodiscard]] std::vector<std::uint32_t> sprite_indices();

/// lit_points: of a sprite before drawing, 0: none. jittered: the view is (RenderView). version: if light is summed at
/// each pixel, otherwise null.
[[nodiscard]] DrawProgram sprite_program(std::uint32_t lit_points, bool clipped, bool jittered,
                                         const ParticleLightVersion* version);

/// Draws the sprites into the targets of a pass whose program has sprite.vert as its vertex shader.
void draw_sprites(DrawPass& pass, FrameBuilder& frame, const ParticlesFrame& particles, BufferRef indices);
/// The indices on the GPU.
[[nodiscard]] BufferRef sprite_index_buffer(FrameBuilder& frame);

/// Blends the sprites over LitOutput.
void add_sprite_pass(FrameBuilder& frame, const ParticlesFrame& particles);

}  // namespace gloam
