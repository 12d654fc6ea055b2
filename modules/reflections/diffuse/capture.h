// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/render/renderer.h"
#include "modules/reflections/captures.h"

namespace gloam {

/// Light that a surface at `eye` gets from others: draws the static scene around it with the light of its lights and
/// its emission, without light of sky and ground on surfaces. The sky itself is seen. light_scale: of the captures.
/// surfaces: those around a probe without a box, for its ProbeNeighbourhood; otherwise empty.
[[nodiscard]] Result<ProbeDiffuse> capture_diffuse(Renderer& renderer, World& world, const dvec3& eye,
                                                   float light_scale, std::span<const CapturedSurface> surfaces,
                                                   JobExecutor& executor);

}  // namespace gloam
