// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// How far the diffuse light of a probe without a box holds.
#pragma once

#include <span>

#include "engine/math/types.h"
#include "modules/reflections/captures.h"

namespace gloam {

/// What a probe sees around it. At a distance r from it, its light is known with a certainty of 1 / (1 + (r / reach)²),
/// because light from a surface falls with the square of the distance. What is not known is the sky's light, as if
/// there were no probe, unless the probe sees no sky. The harmonic mean is that of Ward and Heckbert 1992, "Irradiance
/// Gradients".
struct ProbeNeighbourhood {
  float reach = 0.0f;  ///< harmonic mean of the distances of near surfaces; infinite without any
  float open = 0.0f;   ///< 1 where a quarter or more of a hemisphere is sky, less in proportion
};

/// surfaces: of CapturedParts, one for each cell of a probe's map. unlit: radiance in the same cells without lamps.
/// Surfaces more than eight times as far away as the harmonic mean of all are sky as far as they are as bright as it,
/// lamps or not: the dome of a painted sky. Other sizes: the light holds everywhere.
[[nodiscard]] ProbeNeighbourhood probe_neighbourhood(std::span<const CapturedSurface> surfaces,
                                                     std::span<const vec3> unlit, const vec3& sky);

}  // namespace gloam
