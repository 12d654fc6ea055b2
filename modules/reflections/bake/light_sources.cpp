// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake/light_sources.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "modules/lights/light_names.h"
#include "modules/reflections/bake/picture.h"

namespace gloam {
namespace {

constexpr double kUnreachedShare = 0.01;

double square(double x) { return x * x; }

/// Share of a spot's intensity at the cosine of an angle to its axis, as KHR_lights_punctual recommends.
double cone_share(const Light& light, double cosine) {
  if (light.kind != LightKind::spot) return 1.0;
  const double outer = std::cos(std::min(double{light.outer_angle}, 0.5 * std::numbers::pi));
  const double inner = std::cos(std::min(double{light.inner_angle}, double{light.outer_angle}));
  return square(std::clamp((cosine - outer) / std::max(inner - outer, 1e-3), 0.0, 1.0));
}

/// Mean illuminance of 3 × 3 points of the proxy's front.
double mean_illuminance(const LightSource& source, const PlacedProxy& proxy) {
  double sum = 0.0;
  for (int s = -1; s <= 1; ++s)
    for (int t = -1; t <= 1; ++t)
      sum += illuminance(source, proxy.center + 2.0 / 3.0 * (double(s) * proxy.half_u + double(t) * proxy.half_v),
                         proxy.normal);
  return sum / 9.0;
}

}  // namespace

vec3 LightSource::emitted() const {
  const vec3 all = light.color * light.intensity;
  const auto usable = [](float x) { return std::isfinite(x) && x > 0.0f; };
  return {usable(all.x) ? all.x : 0.0f, usable(all.y) ? all.y : 0.0f, usable(all.z) ? all.z : 0.0f};
}

std::vector<LightSource> light_sources(const World& world) {
  std::vector<LightSource> sources;
  world.view<const Light, const WorldTransform>().each(
      [&](Entity entity, const Light& light, const WorldTransform& transform) {
        const dmat4& m = transform.matrix;
        const dvec3 along = -dvec3(m[2]);
        const double length = glm::length(along);
        LightSource& source = sources.emplace_back();
        source.entity = entity;
        source.light = light;
        source.position = dvec3(m[3]);
        if (length > 0.0) source.direction = along / length;
      });
  std::ranges::sort(sources, {}, [](const LightSource& source) { return source.entity.index; });
  return sources;
}

double illuminance(const LightSource& source, const dvec3& point, const dvec3& normal) {
  const double intensity = luminance_of(dvec3(source.emitted()));
  double result = 0.0;
  if (source.light.kind == LightKind::directional) {
    result = intensity * glm::dot(normal, -source.direction);
  } else {
    const dvec3 offset = source.position - point;
    const double d2 = std::max(glm::dot(offset, offset), 1e-6);
    const dvec3 to_light = offset / std::sqrt(d2);
    const double range = effective_range(source.light);
    result = intensity * range_window(d2 / (range * range)) *
             cone_share(source.light, glm::dot(-to_light, source.direction)) * glm::dot(normal, to_light) / d2;
  }
  return std::isfinite(result) && result > 0.0 ? result : 0.0;
}

Result<std::vector<CapturedProxyLight>> proxy_lights(const World& world, const PlacedProxy& proxy,
                                                     std::string_view names, std::span<const LightSource> lights) {
  const auto named = resolve_light_names(world, names, "gloam.ibr_proxy.lights");
  if (!named.ok()) return named.error();
  std::vector<CapturedProxyLight> chosen;
  std::vector<double> reached;
  double sum = 0.0;
  for (const LightSource& source : lights) {
    const double share = mean_illuminance(source, proxy);
    const bool wanted = named->empty() ? share > 0.0 : std::ranges::find(*named, source.entity) != named->end();
    if (!wanted) continue;
    chosen.push_back({.light = source.entity});
    reached.push_back(share);
    sum += share;
  }
  double all = 0.0;
  for (double& share : reached) {
    share = share > 0.0 ? share / sum : kUnreachedShare;
    all += share;
  }
  for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i].weight = static_cast<float>(reached[i] / all);
  return chosen;
}

}  // namespace gloam
