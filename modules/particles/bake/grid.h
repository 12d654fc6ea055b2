// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/types.h"
#include "modules/particles/baked_light.h"
#include "modules/particles/emitters/placed.h"

namespace gloam {

/// Wanted size of a map's texels, metres. Larger emitters have kMapSide texels along their longest side.
inline constexpr double kMapTexel_m = 0.25;
inline constexpr std::uint32_t kMapSide = 32;

/// An empty map over the emitter's bounds: nearly cubic texels, at least two along each axis.
[[nodiscard]] ParticleLightMap empty_light_map(const PlacedEmitter& emitter);

/// World position of a point of the map's grid. at: in texels, (½, ½, ½) is the centre of the first one.
[[nodiscard]] dvec3 grid_position(const ParticleLightMap& map, const dvec3& at);

}  // namespace gloam
