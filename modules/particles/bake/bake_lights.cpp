// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/bake/bake_lights.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/scene/animated_nodes.h"
#include "modules/lights/components.h"
#include "modules/particles/baked_light.h"
#include "modules/particles/emitters/strongest_lights.h"

namespace gloam {

BakeLights gather_bake_lights(const World& world, const SceneTracer& tracer) {
  BakeLights lights;
  lights.all = gather_lights(world, tracer);
  const AnimatedNodes animated(world);
  for (std::uint32_t i = 0; i < lights.all.lights.size(); ++i) {
    const Entity entity = lights.all.lights[i].entity;
    if (animated.moves(entity)) continue;
    (world.get<Light>(entity).cookie == 0 ? lights.with_flux : lights.with_cookies).push_back(i);
  }
  return lights;
}

std::vector<PlacedEmitter> emitters_at_rest(const World& world) {
  const AnimatedNodes animated(world);
  std::vector<PlacedEmitter> emitters;
  world.view<const ParticleEmitter, const WorldTransform>().each(
      [&](Entity entity, const ParticleEmitter& emitter, const WorldTransform& transform) {
        PlacedEmitter placed;
        if (emits(emitter) && !animated.moves(entity) && place_emitter(entity, emitter, transform.matrix, placed))
          emitters.push_back(placed);
      });
  std::ranges::sort(emitters, {}, [](const PlacedEmitter& e) { return e.entity.index; });
  return emitters;
}

std::vector<std::uint32_t> strongest_with_cookies(const World& world, const BakeLights& lights,
                                                  const PlacedEmitter& emitter, const dvec3& tracer_origin) {
  std::vector<std::pair<double, std::uint32_t>> found;
  for (const std::uint32_t i : lights.with_cookies) {
    const TwinLight& light = lights.all.lights[i];
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
  found.resize(std::min(found.size(), kBakedLights));
  std::vector<std::uint32_t> chosen;
  for (const auto& [strength, i] : found) chosen.push_back(i);
  return chosen;
}

}  // namespace gloam
