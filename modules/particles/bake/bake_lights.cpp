// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/bake/bake_lights.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/scene/posing/animated_nodes.h"
#include "modules/lights/components.h"
#include "modules/particles/baked_light.h"
#include "modules/particles/emitters/strongest_lights.h"

namespace gloam {

namespace {

/// Positions in `all` of the strongest `most` of the chosen lights at the emitter, the strongest first; lights that do
/// not reach it are left out.
std::vector<std::uint32_t> strongest(const World& world, const TwinLights& all,
                                     const std::vector<std::uint32_t>& chosen, const PlacedEmitter& emitter,
                                     const dvec3& tracer_origin, std::size_t most) {
  std::vector<std::pair<double, std::uint32_t>> found;
  for (const std::uint32_t i : chosen) {
    const TwinLight& light = all.lights[i];
    const double strength = light_strength({.entity = light.entity,
                                            .kind = light.kind,
                                            .position = light.position + tracer_origin,
                                            .direction = vec3(light.axis),
                                            .emitted = std::max({light.color.x, light.color.y, light.color.z}),
                                            .range_m = std::sqrt(light.range2),
                                            .outer_angle = world.get<Light>(light.entity).outer_angle},
                                           emitter.bounds);
    if (strength > 0.0) found.emplace_back(-strength, i);
  }
  std::ranges::sort(found);
  found.resize(std::min(found.size(), most));
  std::vector<std::uint32_t> positions;
  for (const auto& [strength, i] : found) positions.push_back(i);
  return positions;
}

}  // namespace

BakeLights gather_bake_lights(const World& world, const SceneTracer& tracer, BakedMoment moment) {
  BakeLights lights;
  lights.all = gather_lights(world, tracer);
  const AnimatedNodes animated(world);
  for (std::uint32_t i = 0; i < lights.all.lights.size(); ++i) {
    const Entity entity = lights.all.lights[i].entity;
    if (moment == BakedMoment::at_rest && animated.moves(entity)) continue;
    (world.get<Light>(entity).cookie == 0 ? lights.with_flux : lights.with_cookies).push_back(i);
  }
  return lights;
}

std::vector<PlacedEmitter> gather_bake_emitters(const World& world, const ParticleBakeOptions& options) {
  const AnimatedNodes animated(world);
  const auto is_chosen = [&](Entity entity) {
    if (options.moment == BakedMoment::at_rest && animated.moves(entity)) return false;
    return options.emitters.empty() || std::ranges::find(options.emitters, entity) != options.emitters.end();
  };
  std::vector<PlacedEmitter> emitters;
  const EmitterSet* set = world.try_resource<EmitterSet>();
  world.view<const ParticleEmitter, const WorldTransform>().each(
      [&](Entity entity, const ParticleEmitter& emitter, const WorldTransform& transform) {
        PlacedEmitter placed;
        if (emits(emitter) && is_chosen(entity) && place_emitter(entity, emitter, transform.matrix, placed)) {
          // The volume of a moment holds the trail of an emitter that moves.
          if (options.moment == BakedMoment::now && set != nullptr)
            for (const PlacedEmitter& known : set->emitters)
              if (known.entity == entity && known.origin == placed.origin) placed.bounds = known.bounds;
          emitters.push_back(placed);
        }
      });
  std::ranges::sort(emitters, {}, [](const PlacedEmitter& e) { return e.entity.index; });
  return emitters;
}

LightsOfMap divide_lights(const World& world, const BakeLights& lights, const PlacedEmitter& emitter,
                          const dvec3& tracer_origin, BakedMoment moment) {
  LightsOfMap divided;
  divided.visibility = strongest(world, lights.all, lights.with_cookies, emitter, tracer_origin, kBakedLights);
  divided.flux = lights.with_flux;
  if (moment == BakedMoment::at_rest) return divided;
  const std::size_t left = kBakedLights - divided.visibility.size();
  for (const std::uint32_t i : strongest(world, lights.all, lights.with_flux, emitter, tracer_origin, left)) {
    divided.visibility.push_back(i);
    std::erase(divided.flux, i);
  }
  return divided;
}

}  // namespace gloam
