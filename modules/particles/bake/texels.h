// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "engine/math/types.h"
#include "engine/render/reference/scene_tracer.h"
#include "engine/scene/resources.h"
#include "modules/particles/bake.h"
#include "modules/particles/bake/bake_lights.h"

namespace gloam {

/// Light that crosses a point: ∫ L dω and ∫ L ω dω of each colour, in lux.
struct Flux {
  dvec3 fluence = dvec3(0.0);
  dvec3 along[3] = {dvec3(0.0), dvec3(0.0), dvec3(0.0)};  ///< red, green and blue
};

/// Flux of the sky and the ground, without shadows, as surfaces have it: a plane with the normal n gets
/// (fluence + 2 n · along) / 4 from it.
[[nodiscard]] Flux ambient_flux(const SceneEnvironment& sky);

/// Inputs of bake_texels(). Numbers of rays: those of `options`.
struct TexelInput {
  const SceneTracer& tracer;
  const TwinLights& lights;
  const LightsOfMap& chosen;  ///< positions in `lights`
  const Flux& ambient;
  const ParticleBakeOptions& options;
};

/// Fills texels [begin, end) of a map's visibility, and of `fluxes`; both have their sizes. Each ray goes from a point
/// of the texel's cell to a point of the emitter: so a texel that a wall cuts has the mean of its cell, and a lamp in a
/// cell does not give infinity.
void bake_texels(const TexelInput& input, std::size_t begin, std::size_t end, ParticleLightMap& map,
                 std::span<Flux> fluxes);

/// Sets the map's light_scale and flux, from the flux of each texel.
void store_flux(std::span<const Flux> fluxes, ParticleLightMap& map);

}  // namespace gloam
