// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/types.h"

namespace gloam {

/// Radius of a local light's emitter for is_bulb(). Emitters with less are given the distance within which nothing
/// blocks a light: maps hold nothing nearer (near planes), and traced rays end there.
inline constexpr double kLeastEmitter_m = 0.05;
/// Greatest distance of a bulb from the emitter's centre, in radii of the emitter.
inline constexpr double kBulbDistance = 1.5;
/// Greatest half diagonal of a bulb, in radii of the emitter.
inline constexpr double kBulbReach = 5.0;

/// Whether an emissive mesh is part of a lamp: the glass or the flame that shines, not something in its way. A bulb
/// does not cast into the maps of its light. It touches the emitter's ball, or almost, and is not much larger. min,
/// max: bounds of the mesh, in the space of `light`. half_diagonal_m: half the diagonal of the mesh's own box; 0 for a
/// mesh that is not emissive. emitter_m: radius of the emitter; below 0: the light is no lamp.
[[nodiscard]] bool is_bulb(const dvec3& light, double emitter_m, const dvec3& min, const dvec3& max,
                           double half_diagonal_m);

}  // namespace gloam
