// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/math/types.h"
#include "engine/render/reference/scene_tracer.h"
#include "engine/scene/resources.h"
#include "modules/particles/bake/bake_lights.h"
#include "modules/particles/baked_light.h"

namespace gloam {

/// Light that crosses a point: ∫ L dω and ∫ L ω dω of each colour, in lux.
struct Flux {
  dvec3 fluence = dvec3(0.0);
  dvec3 along[3] = {dvec3(0.0), dvec3(0.0), dvec3(0.0)};  ///< red, green and blue
};

/// Flux of the sky and the ground, without shadows, as surfaces have it: a plane with the normal n gets
/// (fluence + 2 n · along) / 4 from it.
[[nodiscard]] Flux ambient_flux(const SceneEnvironment& sky);

/// Rays of a texel for all its lights together. A light has as many of them as it has of the texel's light, at least
/// one, at most kRaysPerLight.
inline constexpr std::uint32_t kRaysPerTexel = 64;
inline constexpr std::uint32_t kRaysPerLight = 16;
/// Rays of a light with a cookie.
inline constexpr std::uint32_t kVisibilityRays = 16;

/// Fills texels [begin, end) of a map; flux and visibility have their sizes. cookies: positions in `lights` of
/// map.lights. Each ray goes from a point of the texel's cell to a point of the emitter: so a texel that a wall cuts
/// has the mean of its cell, and a lamp in a cell does not give infinity.
void bake_texels(const SceneTracer& tracer, const BakeLights& lights, std::span<const std::uint32_t> cookies,
                 const Flux& ambient, std::size_t begin, std::size_t end, ParticleLightMap& map);

}  // namespace gloam
