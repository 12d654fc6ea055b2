// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/hit_lights.h"

#include <algorithm>
#include <cmath>

namespace gloam {
namespace {

constexpr double kBehindSurface = 2e-4;  // sine of an angle below a surface, from which on it hides a light

double brightness_of(const dvec3& color) { return color.r + color.g + color.b; }

/// Apparent radius of a light at a point, in radians: as frames have it (arriving_light.glsl).
double half_angle_of(const TwinLight& light, const dvec3& point) {
  if (light.kind == LightKind::directional) return std::atan(light.radius);
  if (!(light.radius > 0.0)) return 0.0;
  return std::min(light.radius / std::max(glm::length(light.position - point), 1e-6), 1.0);
}

}  // namespace

void HitLights::add(const HitSurfaces& hits, std::uint32_t samples, const PixelSequence& sequence) {
  shadow_rays_.clear();
  carried_.clear();
  for (std::uint32_t hit = 0; hit < hits.surfaces.size(); ++hit)
    if (hits.surfaces[hit].hit) choose_lights(hits, hit, samples, sequence);
  add_unblocked_light(hits.radiance);
}

void HitLights::choose_lights(const HitSurfaces& hits, std::uint32_t hit, std::uint32_t samples,
                              const PixelSequence& sequence) {
  const TwinPoint& p = hits.points[hit];
  const dvec3 position(hits.surfaces[hit].position);
  candidates_.clear();
  double total = 0.0;
  for (const TwinLight& light : lights_.lights) {
    dvec3 to_light(0.0);
    const dvec3 illuminance = illuminance_of(light, position, to_light);
    if (!(brightness_of(illuminance) > 0.0) || !(glm::dot(p.normal, to_light) > 0.0)) continue;
    const dvec3 reflected = reflected_light(p, to_light, illuminance, half_angle_of(light, position));
    const double brightness = brightness_of(reflected);
    if (!(brightness > 0.0) || !std::isfinite(brightness)) continue;
    if (!light.casts) {
      hits.radiance[hit] += reflected;
      continue;
    }
    total += brightness;
    candidates_.push_back({&light, reflected, total});
  }
  if (candidates_.empty()) return;
  for (std::uint32_t k = 0; k < samples; ++k) {
    const double at_share = (k + sequence.choice(hit)) / samples;
    const auto chosen = std::lower_bound(candidates_.begin(), candidates_.end() - 1, at_share * total,
                                         [](const Candidate& c, double at) { return c.up_to < at; });
    const double probability = brightness_of(chosen->reflected) / total;
    const Carried carried = {hit, chosen->reflected / (probability * samples)};
    send_shadow_ray(hits, *chosen->light, carried, sequence.emitter(hit * samples + k));
  }
}

void HitLights::send_shadow_ray(const HitSurfaces& hits, const TwinLight& light, const Carried& carried,
                                const PixelSequence::Pair& on_emitter) {
  const TracedSurface& s = hits.surfaces[carried.hit];
  const dvec3 face_normal = glm::normalize(dvec3(s.face_normal));
  ShadowRay shadow;
  // A subsurface material is lit from both sides of its triangles.
  const bool from_behind = s.subsurface && glm::dot(face_normal, light.kind == LightKind::directional
                                                                     ? -light.axis
                                                                     : light.position - dvec3(s.position)) < 0.0;
  const dvec3 start = ray_start(dvec3(s.position), from_behind ? -face_normal : face_normal, camera_);
  if (!aim_at_emitter(light, start, on_emitter.x, on_emitter.y, shadow)) {
    hits.radiance[carried.hit] += carried.light;
    return;
  }
  const double above = glm::dot(dvec3(shadow.direction), face_normal);
  if (!s.subsurface && above < -kBehindSurface * static_cast<double>(glm::length(shadow.direction))) return;
  shadow_rays_.add(shadow, light.bulbs);
  carried_.push_back(carried);
}

void HitLights::add_unblocked_light(std::span<dvec3> radiance) {
  const std::span<const std::uint8_t> blocked = shadow_rays_.blocked(lights_, tracer_);
  for (std::size_t i = 0; i < carried_.size(); ++i)
    if (blocked[i] == 0) radiance[carried_[i].hit] += carried_[i].light;
}

}  // namespace gloam
