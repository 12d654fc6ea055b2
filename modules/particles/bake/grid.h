// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/types.h"
#include "modules/particles/bake.h"
#include "modules/particles/emitters/placed.h"

namespace gloam {

/// An empty map over the emitter's bounds: nearly cubic texels, at least two along each axis.
[[nodiscard]] ParticleLightMap empty_light_map(const PlacedEmitter& emitter, const ParticleBakeOptions& options);

/// World position of a point of the map's grid. at: in texels, (½, ½, ½) is the centre of the first one.
[[nodiscard]] dvec3 grid_position(const ParticleLightMap& map, const dvec3& at);

}  // namespace gloam
