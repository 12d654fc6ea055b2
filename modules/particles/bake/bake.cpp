// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/bake.h"

#include <mutex>
#include <vector>

#include "engine/core/hash.h"
#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "modules/particles/bake/bake_lights.h"
#include "modules/particles/bake/grid.h"
#include "modules/particles/bake/texels.h"
#include "modules/particles/emitters/light_states.h"

namespace gloam {
namespace {

/// Increment it when the same world gives other maps than before.
constexpr std::uint32_t kBakeVersion = 2;
constexpr std::size_t kTexelGrain = 64;

std::vector<Entity> entities_of(const BakeLights& lights, const std::vector<std::uint32_t>& chosen) {
  std::vector<Entity> entities;
  for (const std::uint32_t i : chosen) entities.push_back(lights.all.lights[i].entity);
  return entities;
}

void add_options(Hasher& hasher, const ParticleBakeOptions& options) {
  hasher.value(options.moment).bytes_of(options.texel_m).value(options.most_side);
  hasher.value(options.rays_per_texel).value(options.rays_per_light).value(options.visibility_rays);
  for (const Entity emitter : options.emitters) hasher.value(emitter.index);
}

void add_light(Hasher& hasher, const TwinLight& light, const std::vector<std::uint32_t>& bulbs) {
  hasher.value(light.kind).value(light.casts);
  hasher.bytes_of(light.position).bytes_of(light.axis).bytes_of(light.color);
  for (const double value : {light.range2, light.spot_scale, light.spot_offset, light.radius}) hasher.bytes_of(value);
  hasher.items(bulbs);
}

}  // namespace

ParticleLightMaps bake_particle_light(const ParticleBakeInput& input) {
  const ParticleBakeOptions& options = input.options;
  const BakeLights lights = gather_bake_lights(input.world, input.tracer, options.moment);
  const Flux ambient = ambient_flux(input.world.resource<SceneEnvironment>());
  ParticleLightMaps maps;
  std::vector<LightsOfMap> chosen;
  std::size_t total = 0, done = 0;
  for (const PlacedEmitter& emitter : gather_bake_emitters(input.world, options)) {
    ParticleLightMap map = empty_light_map(emitter, options);
    chosen.push_back(divide_lights(input.world, lights, emitter, input.tracer.origin(), options.moment));
    map.static_lights = entities_of(lights, chosen.back().flux);
    map.lights = entities_of(lights, chosen.back().visibility);
    if (!map.lights.empty()) map.visibility.resize(map.texels());
    total += map.texels();
    maps.maps.push_back(std::move(map));
  }
  std::mutex reporting;
  for (std::size_t m = 0; m < maps.maps.size(); ++m) {
    ParticleLightMap& map = maps.maps[m];
    std::vector<Flux> fluxes(map.texels());
    const TexelInput texels = {input.tracer, lights.all, chosen[m], ambient, options};
    input.executor.parallel_for(map.texels(), kTexelGrain, [&](JobRange range) {
      bake_texels(texels, range.begin, range.end, map, fluxes);
      if (!input.progress) return;
      const std::lock_guard lock(reporting);
      input.progress(done += range.end - range.begin, total);
    });
    store_flux(fluxes, map);
  }
  mark_as_current(input.world, maps);
  return maps;
}

void mark_as_current(const World& world, ParticleLightMaps& maps) {
  LightStates states;
  world.view<const Light, const WorldTransform>().each(
      [&](Entity entity, const Light& light, const WorldTransform& transform) {
        states.add(entity, light, transform.matrix);
      });
  for (ParticleLightMap& map : maps.maps) {
    map.static_state = states.of(map.static_lights);
    map.dynamic_state = states.of(map.lights);
  }
}

std::uint64_t particle_light_content(const World& world, const SceneTracer& tracer,
                                     const ParticleBakeOptions& options) {
  const BakeLights lights = gather_bake_lights(world, tracer, options.moment);
  Hasher hasher;
  hasher.value(kBakeVersion).value(tracer.version()).bytes_of(tracer.origin());
  for (const auto* chosen : {&lights.with_flux, &lights.with_cookies}) {
    hasher.value(chosen->size());
    for (const std::uint32_t i : *chosen)
      add_light(hasher, lights.all.lights[i], lights.all.bulbs[lights.all.lights[i].bulbs]);
  }
  const SceneEnvironment& sky = world.resource<SceneEnvironment>();
  hasher.bytes_of(sky.sky_zenith).bytes_of(sky.sky_horizon).bytes_of(sky.sky_ground);
  for (const PlacedEmitter& emitter : gather_bake_emitters(world, options)) {
    hasher.bytes_of(emitter.origin).bytes_of(emitter.bounds.min).bytes_of(emitter.bounds.max);
    if (emitter.values.metres_per_unit != 1.0f) hasher.bytes_of(emitter.values.metres_per_unit);
  }
  if (options != ParticleBakeOptions{}) add_options(hasher, options);
  return hasher.digest();
}

}  // namespace gloam
