// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/declare/compute_pass.h"
#include "modules/reflections/frame.h"

namespace gloam {

/// probes: probe_constants(). mirrors: whether there are mirrored images.
[[nodiscard]] ComputeProgram surface_program(bool mirrors, const gpu::SpecConstants& probes);
[[nodiscard]] ComputeProgram list_tiles_program(bool mirrors);
[[nodiscard]] ComputeProgram surroundings_program(bool mirrors, const gpu::SpecConstants& probes);

/// Puts SurroundingsOutput on the board, and lists the tiles that hold surfaces that reflect strongly. mirrors: with
/// the cleared MirrorSurfaces::surface.
[[nodiscard]] MirrorSurfaces add_surface_passes(FrameBuilder& frame, const ReflectionUniforms& uniforms, bool mirrors);

/// After lighting: adds the specular ambient light of surfaces that reflect strongly to LitOutput, but for what
/// mirrored images take the place of, and puts StrongAmbient on the board. mirrors: also finds the surfaces that
/// mirrored images serve (MirrorTiles::image), and lists their tiles.
void add_surroundings_passes(FrameBuilder& frame, const ReflectionUniforms& uniforms, MirrorSurfaces& found,
                             bool mirrors);

/// Binds a list of tiles (GLOAM_LIST_…), as shaders/reflections/mirror_surface_api.glsl names it, and dispatches one
/// workgroup per listed tile. The first function also binds the image of mirror surfaces.
void dispatch_mirror_tiles(ComputePass& pass, const MirrorTiles& tiles, std::uint32_t list = GLOAM_LIST_MIRRORS);
void dispatch_listed_tiles(ComputePass& pass, const MirrorTiles& tiles, std::uint32_t list);

}  // namespace gloam
