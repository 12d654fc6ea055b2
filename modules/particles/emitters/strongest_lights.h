// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/ecs/view.h"
#include "engine/math/types.h"
#include "engine/scene/components.h"
#include "engine/schedule/parameters.h"
#include "modules/lights/components.h"
#include "modules/particles/baked_light.h"
#include "modules/particles/emitters/placed.h"

namespace gloam {

/// A light of the world as an emitter sees it.
struct EmitterLight {
  Entity entity = kNoEntity;
  LightKind kind = LightKind::point;
  dvec3 position = dvec3(0.0);
  vec3 direction = vec3(0.0f);  ///< in which it shines, unit length
  double emitted = 0.0;         ///< of the brightest colour channel, candela; directional: lux
  double range_m = 0.0;
  double outer_angle = 0.0;  ///< of a spot, radians
};

/// A light that lights an emitter.
struct ChosenLight {
  Entity entity = kNoEntity;
  /// 0…1. The last of the four fades out before a fifth becomes stronger, so that no light appears or disappears at
  /// once.
  float weight = 1.0f;
  std::uint32_t channel = kBakedLights;  ///< in ParticleLightMap::visibility; kBakedLights: it is not baked
};

/// The lights of one emitter.
struct LightsOfEmitter {
  std::array<ChosenLight, kBakedLights> lights;  ///< the strongest first
  std::uint32_t count = 0;
  std::uint32_t map = ~0u;  ///< index in ParticleLightMaps::maps; ~0u: none that shows today's lights
};

/// The lights of all emitters, in the order of EmitterSet::emitters; a world resource written by system
/// particle_lights.
struct EmitterLights {
  std::vector<LightsOfEmitter> emitters;
  std::uint32_t outdated = 0;  ///< maps that are not used, because their lights or their emitters have changed
};

/// An upper bound of the light's illuminance in the box, lux, which takes distances within a quarter of the box's
/// diagonal as equal. 0 if the light does not reach the box.
[[nodiscard]] double light_strength(const EmitterLight& light, const WorldBox& box);

/// The strongest lights of the emitter by light_strength(), equal ones by entity index. map: null, or the emitter's
/// baked light, whose static lights are left out.
[[nodiscard]] LightsOfEmitter strongest_lights(std::span<const EmitterLight> lights, const WorldBox& box,
                                               const ParticleLightMap* map);

/// The emitter's baked light, or null. maps: as ParticleLightMaps::maps.
[[nodiscard]] const ParticleLightMap* find_light_map(const ParticleLightMaps& maps, Entity emitter);
/// First slice of each map if they are stacked along z; kNoSlices for maps that are not usable or do not fit below
/// kMostMapSlices. These are not used.
inline constexpr std::uint32_t kNoSlices = ~0u;
[[nodiscard]] std::vector<std::uint32_t> first_slices(std::span<const ParticleLightMap> maps);
/// Whether sizes and box of a map fit each other and its limits. Others are not used.
[[nodiscard]] bool is_usable(const ParticleLightMap& map);

/// Chooses the lights of all emitters.
void particle_lights_system(View<const Light, const WorldTransform> lights, Resource<const EmitterSet> set,
                            Resource<const ParticleLightMaps> maps, Resource<EmitterLights> chosen);

}  // namespace gloam
