// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <span>
#include <type_traits>
#include <vector>

#include "engine/core/assert.h"
#include "engine/core/sealed_file.h"
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

class ByteWriter {
 public:
  template <class T>
  requires(std::is_arithmetic_v<T>) void value(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  void layers(const CapturedLayers& layers) {
    for (const std::uint32_t value : {layers.side, layers.mips, layers.count}) this->value(value);
    bytes_.append(reinterpret_cast<const char*>(layers.texels.data()), layers.texels.size() * sizeof(std::uint16_t));
  }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads what ByteWriter has written. After a read beyond the end, all values are 0 and ok() is false.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}

  template <class T>
  requires(std::is_arithmetic_v<T>) [[nodiscard]] T value() {
    T value{};
    copy(&value, sizeof(T));
    return value;
  }
  /// A number of items that take at least `bytes_each` of what is left.
  [[nodiscard]] std::uint32_t count(std::size_t bytes_each) {
    const auto items = value<std::uint32_t>();
    if (items > left_.size() / bytes_each) ok_ = false;
    return ok_ ? items : 0;
  }
  [[nodiscard]] CapturedLayers layers() {
    CapturedLayers layers;
    layers.side = value<std::uint32_t>();
    layers.mips = value<std::uint32_t>();
    layers.count = value<std::uint32_t>();
    if (layers.mips > kMaxMips || layers.side > 1u << kMaxMips) ok_ = false;
    const std::size_t bytes_each = ok_ ? layers.layer_halves() * sizeof(std::uint16_t) : 0;
    if (layers.count > 0 && (bytes_each == 0 || layers.count > left_.size() / bytes_each)) ok_ = false;
    if (!ok_) return {};
    layers.texels.resize(layers.layer_halves() * layers.count);
    copy(layers.texels.data(), bytes_each * layers.count);
    return layers;
  }
  /// One of the entities, by its position.
  [[nodiscard]] Entity entity(const std::vector<Entity>& entities) {
    const auto position = value<std::uint32_t>();
    if (position >= entities.size()) ok_ = false;
    return ok_ ? entities[position] : kNoEntity;
  }
  void require(bool condition) { ok_ = ok_ && condition; }
  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool at_end() const { return ok_ && left_.empty(); }

 private:
  void copy(void* target, std::size_t bytes) {
    if (bytes > left_.size()) ok_ = false;
    if (!ok_ || bytes == 0) return;
    std::memcpy(target, left_.data(), bytes);
    left_.remove_prefix(bytes);
  }
  std::string_view left_;
  bool ok_ = true;
};

std::string identity_of(std::uint64_t content) {
  char text[48];
  std::snprintf(text, sizeof(text), "reflection captures 1 %016llx", static_cast<unsigned long long>(content));
  return text;
}

}  // namespace

std::string encode_captures(const World& world, const ReflectionCaptures& captures) {
  const std::vector<Entity> proxies = entities_with<IbrProxy>(world), probes = entities_with<CubeProbe>(world),
                            lights = entities_with<Light>(world);
  ByteWriter bytes;
  bytes.value(captures.content);
  bytes.layers(captures.proxies);
  for (const Entity proxy : captures.proxy_entities) bytes.value(position_of(proxies, proxy));
  bytes.layers(captures.probes);
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
  captures.proxies = bytes.layers();
  for (std::uint32_t i = 0; i < captures.proxies.count; ++i) captures.proxy_entities.push_back(bytes.entity(proxies));
  captures.probes = bytes.layers();
  for (std::uint32_t i = 0; i < captures.probes.count; ++i) captures.probe_entities.push_back(bytes.entity(probes));
  const std::uint32_t proxy_lights = bytes.count(12);
  for (std::uint32_t i = 0; i < proxy_lights && bytes.ok(); ++i) {
    CapturedProxyLight& light = captures.proxy_lights.emplace_back();
    light.layer = bytes.value<std::uint32_t>();
    light.light = bytes.entity(lights);
    light.weight = bytes.value<float>();
    bytes.require(light.layer < captures.proxies.count);
  }
  const std::uint32_t states = bytes.count(16);
  for (std::uint32_t i = 0; i < states && bytes.ok(); ++i) {
    CapturedLightState& light = captures.lights.emplace_back();
    light.light = bytes.entity(lights);
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
