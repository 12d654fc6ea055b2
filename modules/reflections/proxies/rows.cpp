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
                                          const ProxyTiles& tiles, const ReflectionCaptures& captures, bool all) {
  std::vector<shaders::ProxyRow> rows;
  const std::size_t count = all ? set.proxies.size() : tiles.proxies.size();
  rows.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const PlacedProxy& proxy = set.proxies[all ? i : tiles.proxies[i]];
    shaders::ProxyRow row = placed_row(proxy, view, captures.proxies.side);
    const ReceiverBands bands = receiver_bands(proxy, set.rooms, tiles.rooms, view.position);
    set_heights(row, bands, view.position.y);
    row.room = bands.count > 0 ? 1 : 0;
    const IbrProxy* component = world.try_get<IbrProxy>(proxy.entity);
    row.scaled = component != nullptr && component->kind == IbrProxyKind::fire ? 0.0f : 1.0f;
    if (const auto layer = layer_of(captures, proxy.entity)) {
      row.layer = static_cast<float>(*layer);
      row.dim = proxy_dim(world, captures, *layer);
    }
    rows.push_back(row);
  }
  return rows;
}

std::vector<shaders::ChangedLight> changed_lights(const World& world, const RenderView& view,
                                                  const ReflectionCaptures& captures) {
  std::vector<shaders::ChangedLight> changed;
  for (const CapturedLightState& state : captures.lights) {
    const Light* light = world.try_get<Light>(state.light);
    const auto* transform = world.try_get<WorldTransform>(state.light);
    if (light == nullptr || transform == nullptr) continue;
    const vec3 missing = state.emitted - emitted_now(world, state.light);
    if (missing == vec3(0.0f)) continue;
    Light as_captured = *light;
    as_captured.color = vec3(1.0f);
    as_captured.intensity = std::max({state.emitted.x, state.emitted.y, state.emitted.z, light->intensity});
    const vec2 ramp = light->kind == LightKind::spot ? spot_ramp(*light) : vec2(0.0f, 1.0f);
    const float range = effective_range(as_captured);
    shaders::ChangedLight row{};
    row.position = view.relative(dvec3(transform->matrix[3]));
    row.inverse_range_squared = 1.0f / (range * range);
    row.missing = missing * view.light_scale;
    row.direction = light_direction(dvec3(transform->matrix[2]));
    row.spot_scale = ramp.x;
    row.spot_offset = ramp.y;
    row.directional = light->kind == LightKind::directional ? 1.0f : 0.0f;
    changed.push_back(row);
  }
  return changed;
}

}  // namespace gloam
