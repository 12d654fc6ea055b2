// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "engine/core/assert.h"
#include "engine/core/storage/byte_stream.h"
#include "engine/ecs/view.h"
#include "modules/lights/components.h"
#include "modules/particles/bake.h"
#include "modules/particles/components.h"
#include "modules/particles/emitters/strongest_lights.h"

namespace gloam {
namespace {

template <class T>
std::vector<Entity> entities_having(const World& world) {
  std::vector<Entity> entities;
  world.view<const T>().each([&](Entity entity, const T&) { entities.push_back(entity); });
  std::ranges::sort(entities, {}, &Entity::index);
  return entities;
}

std::uint32_t number_of(const std::vector<Entity>& entities, Entity entity) {
  const auto found = std::ranges::lower_bound(entities, entity.index, {}, &Entity::index);
  GLOAM_ASSERT(found != entities.end() && *found == entity, "maps are of entities of their world");
  return static_cast<std::uint32_t>(found - entities.begin());
}

Entity entity_at(ByteReader& bytes, const std::vector<Entity>& entities) {
  const auto number = bytes.value<std::uint32_t>();
  bytes.require(number < entities.size());
  return bytes.ok() ? entities[number] : kNoEntity;
}

void write_entities(ByteWriter& bytes, const std::vector<Entity>& all, const std::vector<Entity>& chosen) {
  bytes.value(static_cast<std::uint32_t>(chosen.size()));
  for (const Entity entity : chosen) bytes.value(number_of(all, entity));
}

std::vector<Entity> read_entities(ByteReader& bytes, const std::vector<Entity>& all) {
  std::vector<Entity> chosen(bytes.count(sizeof(std::uint32_t)));
  for (Entity& entity : chosen) entity = entity_at(bytes, all);
  return chosen;
}

ParticleLightMap read_map(ByteReader& bytes, const std::vector<Entity>& emitters, const std::vector<Entity>& lights) {
  ParticleLightMap map;
  map.emitter = entity_at(bytes, emitters);
  for (int i = 0; i < 3; ++i) map.origin[i] = bytes.value<double>();
  for (int i = 0; i < 3; ++i) map.box.min[i] = bytes.value<float>();
  for (int i = 0; i < 3; ++i) map.box.max[i] = bytes.value<float>();
  for (int i = 0; i < 3; ++i) map.size[i] = bytes.value<std::uint32_t>();
  for (int i = 0; i < 3; ++i) bytes.require(map.size[i] >= 1 && map.size[i] <= kMostMapSide);
  map.light_scale = bytes.value<float>();
  bytes.require(std::isnormal(map.light_scale) && map.light_scale > 0.0f);
  map.static_lights = read_entities(bytes, lights);
  map.lights = read_entities(bytes, lights);
  const std::size_t texels = bytes.ok() ? map.texels() : 0;
  for (auto& channel : map.flux) channel = bytes.items<BakedFlux>(texels);
  if (!map.lights.empty()) map.visibility = bytes.items<BakedVisibility>(texels);
  bytes.require(is_usable(map));
  return map;
}

}  // namespace

std::string encode_particle_light(const World& world, const ParticleLightMaps& maps) {
  const std::vector<Entity> emitters = entities_having<ParticleEmitter>(world), lights = entities_having<Light>(world);
  ByteWriter bytes;
  bytes.value(static_cast<std::uint32_t>(maps.maps.size()));
  for (const ParticleLightMap& map : maps.maps) {
    bytes.value(number_of(emitters, map.emitter));
    for (int i = 0; i < 3; ++i) bytes.value(map.origin[i]);
    for (int i = 0; i < 3; ++i) bytes.value(map.box.min[i]);
    for (int i = 0; i < 3; ++i) bytes.value(map.box.max[i]);
    for (int i = 0; i < 3; ++i) bytes.value(map.size[i]);
    bytes.value(map.light_scale);
    write_entities(bytes, lights, map.static_lights);
    write_entities(bytes, lights, map.lights);
    for (const auto& channel : map.flux) bytes.items(std::span<const BakedFlux>(channel));
    bytes.items(std::span<const BakedVisibility>(map.visibility));
  }
  return bytes.take();
}

std::optional<ParticleLightMaps> decode_particle_light(const World& world, std::string_view text) {
  const std::vector<Entity> emitters = entities_having<ParticleEmitter>(world), lights = entities_having<Light>(world);
  ByteReader bytes(text);
  ParticleLightMaps maps;
  const std::uint32_t count = bytes.count(64);
  for (std::uint32_t i = 0; i < count && bytes.ok(); ++i) maps.maps.push_back(read_map(bytes, emitters, lights));
  bytes.require(std::ranges::is_sorted(maps.maps, {}, [](const ParticleLightMap& map) { return map.emitter.index; }));
  if (!bytes.at_end()) return std::nullopt;
  mark_as_current(world, maps);
  return maps;
}

}  // namespace gloam
