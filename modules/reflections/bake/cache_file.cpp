// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <span>
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

CapturedLayers read_layers(ByteReader& bytes) {
  CapturedLayers layers;
  layers.side = bytes.value<std::uint32_t>();
  layers.mips = bytes.value<std::uint32_t>();
  layers.count = bytes.value<std::uint32_t>();
  bytes.require(layers.mips <= kMaxMips && layers.side <= 1u << kMaxMips);
  const std::size_t halves_each = bytes.ok() ? layers.layer_halves() : 0;
  bytes.require(layers.count == 0 || halves_each > 0);
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

std::string identity_of(std::uint64_t content) {
  char text[48];
  std::snprintf(text, sizeof(text), "reflection captures 2 %016llx", static_cast<unsigned long long>(content));
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
  for (const Entity proxy : captures.proxy_entities) bytes.value(position_of(proxies, proxy));
  write_layers(bytes, captures.probes);
  for (const Entity probe : captures.probe_entities) bytes.value(position_of(probes, probe));
  bytes.value(static_cast<std::uint32_t>(captures.proxy_lights.size()));
  for (const CapturedProxyLight& light : captures.proxy_lights) {
    bytes.value(light.layer);
    bytes.value(position_of(lights, light.light));
    bytes.value(light.weight);
  }
  bytes.value(static_cast<std::uint32_t>(captures.lights.size()));
  for (const CapturedLightState& light : captures.lights) {
    bytes.value(position_of(lights, light.light));
    for (int channel = 0; channel < 3; ++channel) bytes.value(light.emitted[channel]);
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
  for (std::uint32_t i = 0; i < captures.proxies.count; ++i)
    captures.proxy_entities.push_back(read_entity(bytes, proxies));
  captures.probes = read_layers(bytes);
  for (std::uint32_t i = 0; i < captures.probes.count; ++i)
    captures.probe_entities.push_back(read_entity(bytes, probes));
  const std::uint32_t proxy_lights = bytes.count(12);
  for (std::uint32_t i = 0; i < proxy_lights && bytes.ok(); ++i) {
    CapturedProxyLight& light = captures.proxy_lights.emplace_back();
    light.layer = bytes.value<std::uint32_t>();
    light.light = read_entity(bytes, lights);
    light.weight = bytes.value<float>();
    bytes.require(light.layer < captures.proxies.count);
  }
  const std::uint32_t states = bytes.count(16);
  for (std::uint32_t i = 0; i < states && bytes.ok(); ++i) {
    CapturedLightState& light = captures.lights.emplace_back();
    light.light = read_entity(bytes, lights);
    for (int channel = 0; channel < 3; ++channel) light.emitted[channel] = bytes.value<float>();
  }
  if (!bytes.at_end()) return std::nullopt;
  return captures;
}

Status save_captures(const std::string& path, const World& world, const ReflectionCaptures& captures) {
  return write_sealed(path, identity_of(captures.content), encode_captures(world, captures));
}

std::optional<ReflectionCaptures> load_captures(const std::string& path, const World& world, std::uint64_t content,
                                                LogSink& log) {
  std::error_code fault;
  if (!std::filesystem::exists(path, fault)) return std::nullopt;
  std::optional<ReflectionCaptures> captures;
  if (const auto bytes = read_sealed(path, identity_of(content))) captures = decode_captures(world, *bytes);
  if (!captures || captures->content != content) {
    log.info(path + ": is not used: it is damaged, or its captures are of another state of the scene");
    return std::nullopt;
  }
  return captures;
}

}  // namespace gloam
