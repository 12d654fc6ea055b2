// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/math/types.h"
#include "modules/lights/components.h"

namespace gloam {

/// A placed light as this module reads it. Every number is finite, except the position of a directional light.
struct CloseupLight {
  LightKind kind = LightKind::point;
  dvec3 position = dvec3(0.0);         ///< world
  dvec3 right = dvec3(1.0, 0.0, 0.0);  ///< orthonormal axes; the light shines along `forward`
  dvec3 up = dvec3(0.0, 1.0, 0.0);
  dvec3 forward = dvec3(0.0, 0.0, -1.0);
  double half_angle = 0.0;        ///< spot: half angle of its cone, radians, at most π/2
  double emitter_radius_m = 0.0;  ///< local light: ≥ 0
  double spread = 0.0;            ///< directional: tangent of half its apparent diameter
  double range_m = 0.0;           ///< local light: effective_range
};

/// None for a light whose angles, or position if local, are not finite.
[[nodiscard]] std::optional<CloseupLight> closeup_light(const Light& light, const dmat4& world_from_node);

}  // namespace gloam
