// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/render/reference/reference.h"
#include "modules/reflections/override.h"
#include "modules/reflections/reference/reflection_tracing.h"

// The model of the reference that lighting.indirect is compared with: one diffuse bounce.
// - Rays begin at the surface under a pixel's centre and are distributed by the cosine about its shading normal. Rays
//   below the plane of the drawn triangle are left out.
// - A surface that a ray meets has its emission and the light that it reflects from all lights, shadowed by rays to
//   points of their emitters (HitLights). It has no light of its own surroundings.
// - A ray that meets nothing sees the sky. Fog, fires, particles, grass and blended surfaces are not in the scene.

namespace gloam {

/// The mean radiance of all pixels with a surface. Of the settings, rays and light_samples count. The result depends on
/// the input only, not on the executor.
[[nodiscard]] TracedIndirect trace_indirect(const RadianceInput& input);

/// The result of trace_indirect() for the input's frame: from the input's store, or traced and then stored. Usage error
/// when the input has no tracer or no geometry.
[[nodiscard]] Result<TracedIndirect> find_indirect(const ReferenceInput& input);

/// Puts the result of find_indirect() into the world: later frames show it (VisualizerInfo::trace).
[[nodiscard]] Status put_traced_indirect(World& world, const ReferenceInput& input);

/// The frame drawn with traced light of the surroundings: the reference of a knob.
[[nodiscard]] ReferenceInfo traced_indirect(std::string knob);

}  // namespace gloam
