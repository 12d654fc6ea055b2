// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "modules/reflections/frame.h"

namespace gloam {

/// factors: whether proxies may have some (CaptureFactor).
[[nodiscard]] ComputeProgram proxy_program(const ReflectionKnobs& knobs, bool factors);

/// Tier 2, merged with the hits of tier 1. Writes on `surfaces.surface`.
[[nodiscard]] MirroredLight add_proxy_pass(FrameBuilder& frame, const ReflectionKnobs& knobs,
                                           const ReflectionUniforms& uniforms, const MirrorSurfaces& surfaces,
                                           const ScreenSpaceHits& hits, const ProxyInputs& proxies);

}  // namespace gloam
