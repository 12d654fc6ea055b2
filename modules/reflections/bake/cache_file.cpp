// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <span>
#include <string_view>
#include <vector>

#include "engine/core/assert.h"
#include "engine/core/storage/byte_stream.h"
#include "engine/core/storage/sealed_file.h"
#include "engine/ecs/view.h"
#include "modules/lights/components.h"
#include "modules/reflections/components.h"

namespace gloam {
namespace {

constexpr std::uint32_t kMaxMips = 16;
constexpr std::size_t kMostHalves = std::size_t{1} << 40;

/// Entities with a T, by entity index.
template <class T>
std::vector<Entity> entities_with(const World& world) {
  std::vector<Entity> entities;
  world.view<const T>().each([&](Entity entity, const T&) { entities.push_back(entity); });
  std::ranges::sort(entities, {}, &Entity::index);
  return entities;
}

std::uint32_t position_of(const std::vector<Entity>& entities, Entity entity) {
  const auto found = std::ranges::lower_bound(entities, entity.index, {}, &Entity::index);
  GLOAM_ASSERT(found != entities.end() && *found == entity, "captures are of entities of their world");
  return static_cast<std::uint32_t>(found - entities.begin());
}

void write_layers(ByteWriter& bytes, const CapturedLayers& layers) {
  for (const std::uint32_t value : {layers.side, layers.mips, layers.count}) bytes.value(value);
  bytes.items(std::span<const std::uint16_t>(layers.texels));
}

std::uint32_t mips_of(std::uint32_t side) { return static_cast<std::uint32_t>(std::bit_width(side)); }

CapturedLayers read_layers(ByteReader& bytes) {
  CapturedLayers layers;
  layers.side = bytes.value<std::uint32_t>();
  layers.mips = bytes.value<std::uint32_t>();
  layers.count = bytes.value<std::uint32_t>();
  const bool is_power = layers.side == 0 || std::has_single_bit(layers.side);
  bytes.require(is_power && layers.side <= 1u << kMaxMips && layers.mips <= mips_of(layers.side));
  const std::size_t halves_each = bytes.ok() ? layers.layer_halves() : 0;
  bytes.require(layers.count == 0 || halves_each > 0);
  // Of damaged bytes, the product could exceed std::size_t: there would be fewer texels than layers.
  bytes.require(halves_each == 0 || layers.count <= kMostHalves / halves_each);
  if (!bytes.ok()) return {};
  layers.texels = bytes.items<std::uint16_t>(halves_each * layers.count);
  return bytes.ok() ? layers : CapturedLayers{};
}

/// One of the entities, by its position.
Entity read_entity(ByteReader& bytes, const std::vector<Entity>& entities) {
  const auto position = bytes.value<std::uint32_t>();
  bytes.require(position < entities.size());
  return bytes.ok() ? entities[position] : kNoEntity;
}

void write_parts(ByteWriter& bytes, const std::vector<CapturedParts>& parts) {
  bytes.value(static_cast<std::uint32_t>(parts.size()));
  for (const CapturedParts& part : parts) {
    bytes.value(part.emission);
    bytes.value(part.surface_m);
    bytes.value(static_cast<std::uint32_t>(part.surfaces.size()));
    bytes.items(std::span<const CapturedSurface>(part.surfaces));
    bytes.value(static_cast<std::uint32_t>(part.lamps_lux.size()));
    bytes.items(std::span<const vec3>(part.lamps_lux));
    bytes.value(part.lit);
    bytes.value(part.unlit);
  }
}

/// entities: proxies or probes, of which all or none have parts. layers: of their images.
std::vector<CapturedParts> read_parts(ByteReader& bytes, std::size_t entities, std::uint32_t layers) {
  std::vector<CapturedParts> parts(bytes.count(24));
  bytes.require(parts.empty() || parts.size() == entities);
  for (CapturedParts& part : parts) {
    part.emission = bytes.value<std::int32_t>();
    bytes.require(part.emission >= -1 && part.emission < static_cast<std::int64_t>(layers));
    part.surface_m = bytes.value<float>();
    part.surfaces = bytes.items<CapturedSurface>(bytes.count(sizeof(CapturedSurface)));
    part.lamps_lux = bytes.items<vec3>(bytes.count(12));
    part.lit = bytes.value<float>();
    part.unlit = bytes.value<float>();
  }
  return parts;
}

void write_grid_probe(ByteWriter& bytes, const GridProbe& probe) {
  for (int axis = 0; axis < 3; ++axis) bytes.value(probe.center[axis]);
  for (const vec3* vector : {&probe.half, &probe.lamps_lux})
    for (int axis = 0; axis < 3; ++axis) bytes.value((*vector)[axis]);
  bytes.items(std::span(&probe.diffuse, 1));
}

GridProbe read_grid_probe(ByteReader& bytes) {
  GridProbe probe;
  for (int axis = 0; axis < 3; ++axis) probe.center[axis] = bytes.value<double>();
  for (vec3* vector : {&probe.half, &probe.lamps_lux})
    for (int axis = 0; axis < 3; ++axis) (*vector)[axis] = bytes.value<float>();
  const std::vector<ProbeDiffuse> diffuse = bytes.items<ProbeDiffuse>(1);
  if (!diffuse.empty()) probe.diffuse = diffuse.front();
  return probe;
}

void write_light(ByteWriter& bytes, const CapturedLightState& light) {
  for (int channel = 0; channel < 3; ++channel) bytes.value(light.emitted[channel]);
  bytes.value(static_cast<std::uint32_t>(light.kind));
  for (const float value : {light.range_m, light.cone.x, light.cone.y}) bytes.value(value);
  for (const dvec3* vector : {&light.position, &light.direction})
    for (int axis = 0; axis < 3; ++axis) bytes.value((*vector)[axis]);
}

CapturedLightState read_light(ByteReader& bytes) {
  CapturedLightState light;
  for (int channel = 0; channel < 3; ++channel) light.emitted[channel] = bytes.value<float>();
  const auto kind = bytes.value<std::uint32_t>();
  bytes.require(kind <= static_cast<std::uint32_t>(LightKind::directional));
  light.kind = bytes.ok() ? static_cast<LightKind>(kind) : LightKind::point;
  for (float* value : {&light.range_m, &light.cone.x, &light.cone.y}) *value = bytes.value<float>();
  for (dvec3* vector : {&light.position, &light.direction})
    for (int axis = 0; axis < 3; ++axis) (*vector)[axis] = bytes.value<double>();
  return light;
}

/// Entities by their positions in `of`; at most one for each layer.
std::vector<Entity> read_entities(ByteReader& bytes, const std::vector<Entity>& of, std::uint32_t layers) {
  const std::uint32_t count = bytes.count(4);
  bytes.require(count <= layers);
  std::vector<Entity> entities;
  for (std::uint32_t i = 0; i < count && bytes.ok(); ++i) entities.push_back(read_entity(bytes, of));
  return entities;
}

std::string identity_of(std::uint64_t content) {
  char text[48];
  std::snprintf(text, sizeof(text), "reflection captures 4 %016llx", static_cast<unsigned long long>(content));
  return text;
}

}  // namespace

std::string encode_captures(const World& world, const ReflectionCaptures& captures) {
  const std::vector<Entity> proxies = entities_with<IbrProxy>(world), probes = entities_with<CubeProbe>(world),
                            lights = entities_with<Light>(world);
  ByteWriter bytes;
  bytes.value(captures.content);
  bytes.value(captures.light_scale);
  write_layers(bytes, captures.proxies);
  bytes.value(static_cast<std::uint32_t>(captures.proxy_entities.size()));
  for (const Entity proxy : captures.proxy_entities) bytes.value(position_of(proxies, proxy));
  write_parts(bytes, captures.proxy_parts);
  write_layers(bytes, captures.probes);
  bytes.value(static_cast<std::uint32_t>(captures.probe_entities.size()));
  for (const Entity probe : captures.probe_entities) bytes.value(position_of(probes, probe));
  write_parts(bytes, captures.probe_parts);
  bytes.value(static_cast<std::uint32_t>(captures.probe_diffuse.size()));
  bytes.items(std::span<const ProbeDiffuse>(captures.probe_diffuse));
  bytes.value(static_cast<std::uint32_t>(captures.grid.size()));
  for (const GridProbe& probe : captures.grid) write_grid_probe(bytes, probe);
  bytes.value(static_cast<std::uint32_t>(captures.proxy_lights.size()));
  for (const CapturedProxyLight& light : captures.proxy_lights) {
    bytes.value(light.layer);
    bytes.value(position_of(lights, light.light));
    bytes.value(light.weight);
  }
  bytes.value(static_cast<std::uint32_t>(captures.lights.size()));
  for (const CapturedLightState& light : captures.lights) {
    bytes.value(position_of(lights, light.light));
    write_light(bytes, light);
  }
  return bytes.take();
}

std::optional<ReflectionCaptures> decode_captures(const World& world, std::string_view text) {
  const std::vector<Entity> proxies = entities_with<IbrProxy>(world), probes = entities_with<CubeProbe>(world),
                            lights = entities_with<Light>(world);
  ByteReader bytes(text);
  ReflectionCaptures captures;
  captures.content = bytes.value<std::uint64_t>();
  captures.light_scale = bytes.value<float>();
  bytes.require(std::isnormal(captures.light_scale) && captures.light_scale > 0.0f);
  captures.proxies = read_layers(bytes);
  captures.proxy_entities = read_entities(bytes, proxies, captures.proxies.count);
  captures.proxy_parts = read_parts(bytes, captures.proxy_entities.size(), captures.proxies.count);
  captures.probes = read_layers(bytes);
  captures.probe_entities = read_entities(bytes, probes, captures.probes.count);
  captures.probe_parts = read_parts(bytes, captures.probe_entities.size(), captures.probes.count);
  captures.probe_diffuse = bytes.items<ProbeDiffuse>(bytes.count(sizeof(ProbeDiffuse)));
  bytes.require(captures.probe_diffuse.empty() || captures.probe_diffuse.size() == captures.probe_entities.size());
  captures.grid.resize(bytes.count(sizeof(ProbeDiffuse)));
  for (GridProbe& probe : captures.grid) probe = read_grid_probe(bytes);
  const std::uint32_t proxy_lights = bytes.count(12);
  for (std::uint32_t i = 0; i < proxy_lights && bytes.ok(); ++i) {
    CapturedProxyLight& light = captures.proxy_lights.emplace_back();
    light.layer = bytes.value<std::uint32_t>();
    light.light = read_entity(bytes, lights);
    light.weight = bytes.value<float>();
    bytes.require(light.layer < captures.proxy_entities.size());
  }
  const std::uint32_t states = bytes.count(80);
  for (std::uint32_t i = 0; i < states && bytes.ok(); ++i) {
    const Entity light = read_entity(bytes, lights);
    captures.lights.push_back(read_light(bytes));
    captures.lights.back().light = light;
  }
  if (!bytes.at_end()) return std::nullopt;
  return captures;
}

Status save_captures(const std::string& path, const World& world, const ReflectionCaptures& captures) {
  return write_sealed(path, identity_of(captures.content), encode_captures(world, captures));
}

std::optional<ReflectionCaptures> load_captures(const std::string& path, const World& world, std::uint64_t content,
                                                LogSink& log) {
  SealedFault fault = SealedFault::none;
  std::optional<ReflectionCaptures> captures;
  if (const auto bytes = read_sealed(path, identity_of(content), &fault)) captures = decode_captures(world, *bytes);
  if (captures && captures->content == content) return captures;
  // What is no file cannot be replaced, and saving the captures says so.
  if (fault == SealedFault::absent || fault == SealedFault::not_a_file) return std::nullopt;
  if (fault == SealedFault::other) {
    log.write_from("reflections", LogLevel::info, path + ": is not used: it is of another state of the scene");
    return std::nullopt;
  }
  const std::string_view reason = text_of(fault == SealedFault::none ? SealedFault::damaged : fault);
  log.write_from("reflections", LogLevel::warning, path + ": " + std::string(reason) + "; the captures are made again");
  return std::nullopt;
}

}  // namespace gloam
