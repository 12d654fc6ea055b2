// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "modules/reflections/frame.h"

namespace gloam {

[[nodiscard]] ComputeProgram mirror_surface_program();

/// Finds the surfaces that screen space and proxies serve, and lists the tiles that hold one.
[[nodiscard]] MirrorSurfaces add_mirror_surface_pass(FrameBuilder& frame, const ReflectionUniforms& uniforms);

/// Binds the list of tiles and the image of mirror surfaces, as shaders/reflections/mirror_surface_api.glsl names them,
/// and dispatches one workgroup per listed tile.
void dispatch_mirror_tiles(ComputePass& pass, const MirrorTiles& tiles);

}  // namespace gloam
