// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/render/declare/compute_pass.h"
#include "modules/reflections/frame.h"

namespace gloam {

[[nodiscard]] ComputeProgram planar_program(const ReflectionKnobs& knobs);

/// The view's mirror, if a companion of the view has drawn the mirrored scene in this frame.
[[nodiscard]] std::optional<PlanarMirror> drawn_planar_mirror(const FrameBuilder& frame);

/// Takes the light from the companion's picture, in place of screen space and proxies. mirror: drawn_planar_mirror().
/// Writes on `surfaces.surface`.
[[nodiscard]] MirroredLight add_planar_pass(FrameBuilder& frame, const ReflectionKnobs& knobs,
                                            const ReflectionUniforms& uniforms, const MirrorSurfaces& surfaces,
                                            const PlanarMirror& mirror);

}  // namespace gloam
