// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/strongest_lights.h"

#include <algorithm>
#include <cmath>

#include "engine/math/finite.h"
#include "modules/particles/emitters/light_states.h"

namespace gloam {
namespace {

/// The last light has its full weight if it is this much stronger than the next one, relative to its own strength.
constexpr double kFadeShare = 0.2;

/// The most that the spot's cone lets into the sphere.
double cone_share(const EmitterLight& light, const dvec3& to_box, double distance, double radius) {
  if (light.kind != LightKind::spot || distance <= radius) return 1.0;
  const double angle = std::acos(std::clamp(glm::dot(to_box / distance, dvec3(light.direction)), -1.0, 1.0));
  return angle - std::asin(std::min(radius / distance, 1.0)) < light.outer_angle ? 1.0 : 0.0;
}

bool place_light(Entity entity, const Light& light, const dmat4& matrix, EmitterLight& placed) {
  const vec3 emitted = light.color * light.intensity;
  placed = {entity, light.kind};
  placed.position = dvec3(matrix[3]);
  placed.emitted = static_cast<double>(std::max({emitted.x, emitted.y, emitted.z}));
  placed.range_m = static_cast<double>(effective_range(light));
  placed.outer_angle = static_cast<double>(light.outer_angle);
  if (!is_finite(placed.position) || !is_finite(dvec3(matrix[2])) || !is_finite(emitted)) return false;
  placed.direction = light_direction(dvec3(matrix[2]));
  return placed.emitted > 0.0 && !std::isnan(placed.outer_angle);
}

/// Whether the map's volume holds all of the box, but for rounding.
bool holds(const ParticleLightMap& map, const WorldBox& box) {
  const double slack = 1e-4 * glm::length(box.max - box.min);
  const dvec3 from = map.origin + dvec3(map.box.min) - slack, to = map.origin + dvec3(map.box.max) + slack;
  return glm::all(glm::lessThanEqual(from, box.min)) && glm::all(glm::lessThanEqual(box.max, to));
}

double volume_of(const ParticleLightMap& map) {
  const dvec3 side = dvec3(map.box.max) - dvec3(map.box.min);
  return side.x * side.y * side.z;
}

/// The map that lights an emitter: its own if it is where its map was made; otherwise the smallest whose volume it is
/// in. Null if there is none that shows today's lights. current: whether it does, by map.
const ParticleLightMap* map_for(const PlacedEmitter& emitter, const ParticleLightMaps& maps,
                                const std::vector<bool>& current) {
  const auto shows_today = [&](const ParticleLightMap& map) {
    return current[static_cast<std::size_t>(&map - maps.maps.data())];
  };
  const ParticleLightMap* own = find_light_map(maps, emitter.entity);
  if (own != nullptr && shows_today(*own) && own->origin == emitter.origin &&
      (emitter.path.empty() || holds(*own, emitter.bounds)))
    return own;
  const ParticleLightMap* found = nullptr;
  for (const ParticleLightMap& map : maps.maps)
    if (shows_today(map) && holds(map, emitter.bounds) && (found == nullptr || volume_of(map) < volume_of(*found)))
      found = &map;
  return found;
}

}  // namespace

double light_strength(const EmitterLight& light, const WorldBox& box) {
  if (light.kind == LightKind::directional) return light.emitted;
  const dvec3 to_box = 0.5 * (box.min + box.max) - light.position;
  const double distance = glm::length(to_box), radius = 0.5 * glm::length(box.max - box.min);
  const dvec3 beyond = glm::max(glm::max(box.min - light.position, light.position - box.max), dvec3(0.0));
  const double nearest = glm::length(beyond);
  if (!(nearest < light.range_m)) return 0.0;
  const double share = nearest / light.range_m;
  const double near = std::max({nearest, 0.5 * radius, 1e-3});
  return light.emitted * range_window(share * share) * cone_share(light, to_box, distance, radius) / (near * near);
}

LightsOfEmitter strongest_lights(std::span<const EmitterLight> lights, const WorldBox& box,
                                 const ParticleLightMap* map) {
  struct Ranked {
    double strength = 0.0;
    Entity entity = kNoEntity;
  };
  std::vector<Ranked> ranked;
  for (const EmitterLight& light : lights) {
    const bool is_static =
        map != nullptr && std::ranges::find(map->static_lights, light.entity) != map->static_lights.end();
    const double strength = is_static ? 0.0 : light_strength(light, box);
    if (strength > 0.0) ranked.push_back({strength, light.entity});
  }
  const std::size_t wanted = std::min(ranked.size(), kBakedLights + 1);
  std::partial_sort(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(wanted), ranked.end(),
                    [](const Ranked& a, const Ranked& b) {
                      return a.strength != b.strength ? a.strength > b.strength : a.entity.index < b.entity.index;
                    });
  LightsOfEmitter chosen;
  const double next = ranked.size() > kBakedLights ? ranked[kBakedLights].strength : 0.0;
  for (std::size_t i = 0; i < std::min(ranked.size(), kBakedLights); ++i) {
    ChosenLight& light = chosen.lights[chosen.count++];
    light.entity = ranked[i].entity;
    const double lead = (ranked[i].strength - next) / (kFadeShare * ranked[i].strength);
    light.weight = static_cast<float>(std::min(lead, 1.0));
    if (map == nullptr || map->visibility.empty()) continue;
    const auto baked = std::ranges::find(map->lights, light.entity);
    const auto channel = static_cast<std::size_t>(baked - map->lights.begin());
    if (baked != map->lights.end() && channel < kBakedLights) light.channel = static_cast<std::uint32_t>(channel);
  }
  return chosen;
}

const ParticleLightMap* find_light_map(const ParticleLightMaps& maps, Entity emitter) {
  const auto found = std::ranges::lower_bound(maps.maps, emitter.index, {},
                                              [](const ParticleLightMap& map) { return map.emitter.index; });
  if (found == maps.maps.end() || found->emitter != emitter || !is_usable(*found)) return nullptr;
  return &*found;
}

std::vector<std::uint32_t> first_slices(std::span<const ParticleLightMap> maps) {
  std::vector<std::uint32_t> first;
  std::uint32_t next = 0;
  for (const ParticleLightMap& map : maps) {
    const bool fits = is_usable(map) && next + map.size.z <= kMostMapSlices;
    first.push_back(fits ? next : kNoSlices);
    if (fits) next += map.size.z;
  }
  return first;
}

bool is_usable(const ParticleLightMap& map) {
  for (int i = 0; i < 3; ++i)
    if (map.size[i] == 0 || map.size[i] > kMostMapSide || !(map.box.min[i] < map.box.max[i])) return false;
  if (!is_finite(map.origin) || !is_finite(map.box.min) || !is_finite(map.box.max)) return false;
  for (const auto& channel : map.flux)
    if (channel.size() != map.texels()) return false;
  return map.visibility.empty() || map.visibility.size() == map.texels();
}

void particle_lights_system(View<const Light, const WorldTransform> lights, Resource<const EmitterSet> set,
                            Resource<const ParticleLightMaps> maps, Resource<EmitterLights> chosen) {
  std::vector<EmitterLight> placed;
  LightStates states;
  lights.each([&](Entity entity, const Light& light, const WorldTransform& transform) {
    if (!maps->maps.empty()) states.add(entity, light, transform.matrix);
    EmitterLight found;
    if (place_light(entity, light, transform.matrix, found)) placed.push_back(found);
  });
  const std::vector<std::uint32_t> slices = first_slices(maps->maps);
  chosen->emitters.clear();
  chosen->outdated = 0;
  std::vector<bool> current;  // by map
  for (std::size_t i = 0; i < maps->maps.size(); ++i) {
    const ParticleLightMap& map = maps->maps[i];
    current.push_back(slices[i] != kNoSlices && is_usable(map) && states.of(map.static_lights) == map.static_state &&
                      states.of(map.lights) == map.dynamic_state);
  }
  for (const PlacedEmitter& emitter : set->emitters) {
    const ParticleLightMap* own = find_light_map(*maps, emitter.entity);
    if (own != nullptr && slices[static_cast<std::size_t>(own - maps->maps.data())] == kNoSlices) own = nullptr;
    const ParticleLightMap* map = map_for(emitter, *maps, current);
    chosen->outdated += own != nullptr && own != map ? 1 : 0;
    chosen->emitters.push_back(strongest_lights(placed, emitter.bounds, map));
    if (map != nullptr) chosen->emitters.back().map = static_cast<std::uint32_t>(map - maps->maps.data());
  }
}

}  // namespace gloam
