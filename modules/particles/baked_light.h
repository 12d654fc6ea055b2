// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Baked light of particle emitters (Thief §1.4): a small volume over the bounds of each emitter with the light of
// static lights, and the visibility of up to four dynamic lights. Only the data: the room modules/particles/bake makes
// it, the room modules/particles/lighting uploads and reads it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/math/bounds.h"
#include "engine/math/types.h"

namespace gloam {

/// Dynamic lights of one emitter whose visibility may be baked.
inline constexpr std::size_t kBakedLights = 4;
/// Most texels of a map along each axis.
inline constexpr std::uint32_t kMostMapSide = 64;
/// Most texels of all maps of a world along z together; every device has volumes of this depth.
inline constexpr std::uint32_t kMostMapSlices = 2048;

/// One colour channel of a texel's static light: half floats of (flux.x, flux.y, flux.z, fluence), both in lux ·
/// ParticleLightMap::light_scale. The fluence is ∫ L dω over all directions, the flux ∫ L ω dω, where L (cd/m²) arrives
/// from the unit direction ω of the world. A light whose illuminance is E on a plane that faces it adds (E · to_light,
/// E); |flux| ≤ fluence. Values are finite, at most 65504.
using BakedFlux = std::array<std::uint16_t, 4>;
/// Visibility of the lights in `ParticleLightMap::lights`, 0…255 for 0…1.
using BakedVisibility = std::array<std::uint8_t, kBakedLights>;

/// Baked light of one emitter. Texel (x, y, z) has index (z · size.y + y) · size.x + x; its centre is at
/// box.min + (x + ½, y + ½, z + ½) / size · (box.max − box.min). Between centres light is interpolated, outside it is
/// clamped.
struct ParticleLightMap {
  Entity emitter = kNoEntity;  ///< has ParticleEmitter
  dvec3 origin = dvec3(0.0);   ///< world position that `box` is relative to
  Aabb box;                    ///< axis-aligned in the world; not empty
  uvec3 size = uvec3(0);       ///< texels, each 1…kMostMapSide
  /// Factor from lux to the half floats of `flux`, a power of two: the greatest, at most 1, that all of them hold, or
  /// that leaves half of the texels above 1, so that a lamp in the cloud does not cost the others their precision.
  float light_scale = 1.0f;
  /// Light of the static lights, of the sky and of the ground, with their shadows; red, green and blue. Each has a
  /// texel for each point of the grid.
  std::array<std::vector<BakedFlux>, 3> flux;
  /// A texel for each point of the grid; empty: all is visible.
  std::vector<BakedVisibility> visibility;
  /// The dynamic lights of `visibility`; at most kBakedLights.
  std::vector<Entity> lights;
  /// The lights whose light is in `flux`, ascending by Entity::index. All others are dynamic: the four strongest at the
  /// emitter light it, without shadows if they are not in `lights`.
  std::vector<Entity> static_lights;
  /// LightStates::of() static_lights and then of lights, when the map was made. If it differs in a frame, lights have
  /// changed since, and the frame does not use the map.
  std::uint64_t static_state = 0, dynamic_state = 0;

  [[nodiscard]] std::size_t texels() const { return std::size_t{size.x} * size.y * size.z; }
};

/// The maps of a world; a world resource. An emitter without a map, or that is not where it was when its map was made,
/// takes the smallest other map whose box holds all of its bounds. Without one it is lit by the four strongest of all
/// lights where it is now, unshadowed, and by the sky and the ground.
struct ParticleLightMaps {
  std::vector<ParticleLightMap> maps;  ///< ascending by Entity::index of the emitters, at most one of each
  std::uint64_t version = 0;           ///< raise it with each change; the maps are uploaded again
  bool per_pixel = false;              ///< light is summed at each pixel; overrides the knobs. For references
};

}  // namespace gloam
