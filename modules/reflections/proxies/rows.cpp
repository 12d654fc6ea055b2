// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/proxies/rows.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/scene/components.h"
#include "modules/lights/components.h"
#include "modules/reflections/components.h"
#include "modules/reflections/culling/rooms.h"

namespace gloam {
namespace {

constexpr float kNoHeight = 1e30f;

float luminance(const vec3& color) { return glm::dot(color, vec3(0.2126f, 0.7152f, 0.0722f)); }

vec3 emitted_now(const World& world, Entity light) {
  const Light* found = world.try_get<Light>(light);
  return found == nullptr ? vec3(0.0f) : found->color * found->intensity;
}

std::optional<vec3> emitted_at_capture(const ReflectionCaptures& captures, Entity light) {
  const auto found =
      std::lower_bound(captures.lights.begin(), captures.lights.end(), light,
                       [](const CapturedLightState& state, Entity e) { return state.light.index < e.index; });
  if (found == captures.lights.end() || found->light != light) return std::nullopt;
  return found->emitted;
}

std::optional<std::uint32_t> layer_of(const ReflectionCaptures& captures, Entity proxy) {
  const auto& entities = captures.proxy_entities;
  const auto found =
      std::lower_bound(entities.begin(), entities.end(), proxy, [](Entity a, Entity b) { return a.index < b.index; });
  if (found == entities.end() || *found != proxy) return std::nullopt;
  return static_cast<std::uint32_t>(found - entities.begin());
}

/// Bands of world heights as heights relative to the camera.
void set_heights(shaders::ProxyRow& row, const ReceiverBands& bands, double camera_y) {
  static_assert(ReceiverBands::kCapacity == 4, "a component for each band");
  row.lowest_y = vec4(kNoHeight);
  row.highest_y = vec4(-kNoHeight);
  const auto relative = [&](double height) {
    return static_cast<float>(std::clamp(height - camera_y, -double{kNoHeight}, double{kNoHeight}));
  };
  for (std::size_t i = 0; i < bands.count; ++i) {
    row.lowest_y[static_cast<int>(i)] = relative(bands.bands[i].lowest_m);
    row.highest_y[static_cast<int>(i)] = relative(bands.bands[i].highest_m);
  }
}

shaders::ProxyRow placed_row(const PlacedProxy& proxy, const RenderView& view, std::uint32_t image_side) {
  shaders::ProxyRow row{};
  row.center = view.relative(proxy.center);
  row.normal = vec3(proxy.normal);
  const dvec3 across_u = glm::cross(proxy.half_v, proxy.normal), across_v = glm::cross(proxy.normal, proxy.half_u);
  row.to_u = vec3(across_u / glm::dot(across_u, proxy.half_u));
  row.to_v = vec3(across_v / glm::dot(across_v, proxy.half_v));
  const double u = glm::length(proxy.half_u), v = glm::length(proxy.half_v);
  const double radius = std::max(glm::length(proxy.half_u + proxy.half_v), glm::length(proxy.half_u - proxy.half_v));
  row.radius_m = static_cast<float>(radius * (1.0 + 1e-5));
  row.texel_m = static_cast<float>(2.0 * std::max(u, v) / std::max(image_side, 1u));
  return row;
}

/// Appends equal factors for all cells of a proxy; returns the first.
float own_factor(float dim, std::vector<vec4>& cells) {
  const auto first = static_cast<float>(cells.size());
  cells.insert(cells.end(), std::size_t{kProxyCells} * kProxyCells, vec4(vec3(dim), 1.0f));
  return first;
}

void set_light(shaders::ProxyRow& row, const World& world, const ReflectionCaptures& captures,
               std::span<const CaptureFactor> factors, std::uint32_t layer, std::vector<vec4>& cells) {
  const IbrProxy* proxy = world.try_get<IbrProxy>(captures.proxy_entities[layer]);
  row.layer = static_cast<float>(layer);
  row.emission = -1.0f;
  row.opacity = 1.0f;
  row.factor = -1.0f;
  if (proxy != nullptr && own_light(*proxy)) {
    const float dim = proxy_dim(world, captures, layer);
    row.opacity = std::min(dim, 1.0f);
    if (dim != 1.0f) row.factor = own_factor(dim, cells);
    return;
  }
  if (layer < factors.size()) row.factor = static_cast<float>(factors[layer].first);
  if (layer < captures.proxy_parts.size()) row.emission = static_cast<float>(captures.proxy_parts[layer].emission);
}

}  // namespace

float proxy_dim(const World& world, const ReflectionCaptures& captures, std::uint32_t layer) {
  float dim = 0.0f;
  bool has_lights = false;
  const auto first =
      std::lower_bound(captures.proxy_lights.begin(), captures.proxy_lights.end(), layer,
                       [](const CapturedProxyLight& light, std::uint32_t wanted) { return light.layer < wanted; });
  for (auto light = first; light != captures.proxy_lights.end() && light->layer == layer; ++light) {
    const float then = luminance(emitted_at_capture(captures, light->light).value_or(vec3(0.0f)));
    const float now = luminance(emitted_now(world, light->light));
    dim += light->weight * (then > 0.0f ? std::min(now / then, 8.0f) : 0.0f);
    has_lights = true;
  }
  return has_lights ? dim : 1.0f;
}

std::vector<shaders::ProxyRow> proxy_rows(const World& world, const RenderView& view, const ProxySet& set,
                                          const ProxyTiles& tiles, const ReflectionCaptures& captures,
                                          std::span<const CaptureFactor> factors, bool all, std::vector<vec4>& cells) {
  std::vector<shaders::ProxyRow> rows;
  const std::size_t count = all ? set.proxies.size() : tiles.proxies.size();
  rows.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const PlacedProxy& proxy = set.proxies[all ? i : tiles.proxies[i]];
    shaders::ProxyRow row = placed_row(proxy, view, captures.proxies.side);
    const ReceiverBands bands = receiver_bands(proxy, set.rooms, tiles.rooms, view.position, set.unit);
    set_heights(row, bands, view.position.y);
    row.room = bands.count > 0 ? 1 : 0;
    if (const auto layer = layer_of(captures, proxy.entity)) set_light(row, world, captures, factors, *layer, cells);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace gloam
