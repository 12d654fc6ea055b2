// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/fog/lamp_scattering.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "engine/core/assert.h"
#include "engine/math/low_discrepancy.h"
#include "modules/fog/model.h"

namespace gloam {
namespace {

constexpr double kEvenPhase = 0.07957747154594766788;  // 1 / 4π
constexpr double kGoldenRatio = 0.61803398874989484820;
constexpr double kLeastRayShare = 1e-9;  // of a ray's length: a lamp on the ray counts as this far from it
constexpr std::uint32_t kFewestPoints = 16;

double brightness_of(const dvec3& color) { return color.r + color.g + color.b; }

/// The part of a ray inside a sphere around the light. Returns false if there is none.
bool clip_to_range(const TwinLight& light, const FogRay& ray, double& begin, double& end) {
  const dvec3 to_light = light.position - ray.start;
  const double nearest = glm::dot(to_light, ray.direction);
  const dvec3 aside = to_light - nearest * ray.direction;
  const double half = std::sqrt(std::max(light.range2 - glm::dot(aside, aside), 0.0));
  begin = std::max(begin, nearest - half);
  end = std::min(end, nearest + half);
  return begin < end;
}

/// The part of a ray inside a spot's cone: where (p · axis)² ≥ cos² |p|², on the side that the axis points to.
bool clip_to_cone(const TwinLight& light, const FogRay& ray, double& begin, double& end) {
  const dvec3 from_apex = ray.start - light.position;
  const double cosine = -light.spot_offset / light.spot_scale, c2 = cosine * cosine;
  const double along = glm::dot(ray.direction, light.axis), apart = glm::dot(from_apex, light.axis);
  const double a = along * along - c2;
  const double b = along * apart - c2 * glm::dot(from_apex, ray.direction);
  const double c = apart * apart - c2 * glm::dot(from_apex, from_apex);
  if (std::abs(a) < 1e-9) return true;  // parallel to the cone's side: the light's own falloff ends it
  const double discriminant = b * b - a * c;
  if (a < 0.0 && discriminant <= 0.0) return false;
  const double root = std::sqrt(std::max(discriminant, 0.0));
  const double low = (-b - std::copysign(root, a)) / a, high = (-b + std::copysign(root, a)) / a;
  if (a < 0.0) {
    if (apart + 0.5 * (low + high) * along < 0.0) return false;
    begin = std::max(begin, low);
    end = std::min(end, high);
  } else if (along > 0.0) {
    begin = std::max(begin, high);
  } else {
    end = std::min(end, low);
  }
  return begin < end;
}

/// Points evenly spread by the angle at which a light sees them.
class AnglePoints {
 public:
  AnglePoints(const TwinLight& light, const FogRay& ray, double begin, double end) {
    const dvec3 to_light = light.position - ray.start;
    nearest_ = glm::dot(to_light, ray.direction);
    // Inside the emitter the illuminance does not grow further.
    height_ = std::max({glm::length(to_light - nearest_ * ray.direction), 0.5 * light.radius,
                        kLeastRayShare * ray.length, std::numeric_limits<double>::min()});
    first_ = std::atan((begin - nearest_) / height_);
    angle_ = std::atan((end - nearest_) / height_) - first_;
  }
  [[nodiscard]] double place(double u) const { return nearest_ + height_ * std::tan(first_ + u * angle_); }
  [[nodiscard]] double density(double at) const {
    const double away = at - nearest_;
    return angle_ > 0.0 ? height_ / (angle_ * (height_ * height_ + away * away)) : 0.0;
  }

 private:
  double nearest_ = 0.0, height_ = 1.0, first_ = 0.0, angle_ = 0.0;
};

/// Points spread by the transmittance of the fog before them.
class PathPoints {
 public:
  PathPoints(double density, double begin, double end)
      : density_(density), begin_(begin), scattered_(-std::expm1(-density * (end - begin))) {}
  [[nodiscard]] double place(double u) const { return begin_ - std::log1p(-u * scattered_) / density_; }
  [[nodiscard]] double density(double at) const { return density_ * std::exp(-density_ * (at - begin_)) / scattered_; }

 private:
  double density_, begin_, scattered_;
};

dvec3 view_forward(const RenderView& view) {
  return {-view.view_from_relative[0][2], -view.view_from_relative[1][2], -view.view_from_relative[2][2]};
}

/// The ray of a pixel, from the camera or its plane. distance: to the surface; infinite for the sky.
FogRay pixel_ray(const GeometryPicture& geometry, std::uint32_t x, std::uint32_t y, double distance, const Fog& fog,
                 const dvec3& camera) {
  const RenderView& view = geometry.view;
  const dvec3 position = std::isinf(distance) ? surface_position(view, x, y, 1.0f) : geometry.position(x, y);
  FogRay ray;
  ray.length = std::min(distance, static_cast<double>(fog.sky_distance_m));
  if (view.camera.orthographic) {
    ray.direction = view_forward(view);
    ray.start = camera + position - glm::dot(position, ray.direction) * ray.direction;
  } else {
    ray.direction = glm::normalize(position);
    ray.start = camera;
  }
  return ray;
}

}  // namespace

LampScattering::LampScattering(const TwinLights& lights, const SceneTracer& tracer, const Fog& fog,
                               std::uint32_t samples)
    : lights_(lights),
      tracer_(tracer),
      density_(static_cast<double>(fog.density)),
      longest_path_(static_cast<double>(fog.sky_distance_m)),
      samples_(std::max(samples, 1u)) {}

dvec3 LampScattering::along(const FogRay& ray, std::uint32_t pixel) {
  light_ = dvec3(0.0);
  // The light of infinitely dense fog ends at the camera.
  if (!(density_ > 0.0) || !std::isfinite(density_) || !(ray.length > 0.0)) return light_;
  find_lit_parts(ray);
  if (parts_.empty()) return light_;
  points_.clear();
  const auto lights = static_cast<std::uint32_t>(parts_.size());
  const std::uint32_t count = std::max(samples_ / lights, kFewestPoints);
  const double shift = unit_fraction(permuted(pixel + 1u));
  for (std::uint32_t i = 0; i < lights; ++i) add_points(ray, parts_[i], count, shift + i * kGoldenRatio);
  send_shadow_rays(pixel);
  add_unblocked();
  return light_;
}

void LampScattering::find_lit_parts(const FogRay& ray) {
  parts_.clear();
  for (const TwinLight& light : lights_.lights) {
    LitPart part = {&light, 0.0, ray.length};
    if (light.kind != LightKind::directional && !clip_to_range(light, ray, part.begin, part.end)) continue;
    if (light.kind == LightKind::spot && !clip_to_cone(light, ray, part.begin, part.end)) continue;
    parts_.push_back(part);
  }
}

void LampScattering::add_points(const FogRay& ray, const LitPart& part, std::uint32_t count, double shift) {
  const PathPoints by_path(density_, part.begin, part.end);
  const auto even = [&](std::uint32_t i, std::uint32_t of, double offset) {
    return (i + glm::fract(shift + offset)) / of;
  };
  if (part.light->kind == LightKind::directional) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const double at = std::clamp(by_path.place(even(i, count, 0.0)), part.begin, part.end);
      add_point(ray, part, at, 1.0 / (count * by_path.density(at)));
    }
    return;
  }
  const AnglePoints by_angle(*part.light, ray, part.begin, part.end);
  const std::uint32_t half = (count + 1) / 2;
  for (std::uint32_t i = 0; i < 2 * half; ++i) {
    const double place = i < half ? by_angle.place(even(i, half, 0.0)) : by_path.place(even(i - half, half, 0.5));
    const double at = std::clamp(place, part.begin, part.end);
    add_point(ray, part, at, 1.0 / (half * (by_angle.density(at) + by_path.density(at))));
  }
}

void LampScattering::add_point(const FogRay& ray, const LitPart& part, double at, double weight) {
  LitPoint point = {part.light, ray.start + at * ray.direction};
  dvec3 to_light(0.0);
  const dvec3 illuminance = illuminance_of(*part.light, point.position, to_light);
  double way = longest_path_, inside = 1.0;
  if (part.light->kind != LightKind::directional) {
    const double distance = glm::length(part.light->position - point.position);
    way = std::min(distance, longest_path_);
    if (distance < part.light->radius) inside = std::pow(distance / part.light->radius, 2);
  }
  const double scattered = (1.0 - static_cast<double>(kFogForwardShare)) * density_ * kEvenPhase * weight;
  point.carried = illuminance * (inside * scattered * std::exp(-density_ * (at + way)));
  const double brightness = brightness_of(point.carried);
  if (!(brightness > 0.0) || !std::isfinite(brightness)) return;
  if (!part.light->casts) {
    light_ += point.carried;
    return;
  }
  point.up_to = (points_.empty() ? 0.0 : points_.back().up_to) + brightness;
  points_.push_back(point);
}

void LampScattering::send_shadow_rays(std::uint32_t pixel) {
  rays_.clear();
  carried_.clear();
  if (points_.empty()) return;
  constexpr double kRoot = 1.32471795724474602596;  // of x³ = x + 1 (Roberts 2018)
  const double total = points_.back().up_to;
  const double choice = unit_fraction(permuted(pixel + 0x10000001u));
  const double shift_x = unit_fraction(permuted(pixel + 0x20000001u));
  const double shift_y = unit_fraction(permuted(pixel + 0x40000001u));
  auto point = points_.begin();
  for (std::uint32_t k = 0; k < samples_; ++k) {
    const double up_to = total * (k + choice) / samples_;
    while (point + 1 != points_.end() && point->up_to < up_to) ++point;
    const dvec3 carried = point->carried * (total / (brightness_of(point->carried) * samples_));
    const double x = glm::fract(shift_x + k / kRoot), y = glm::fract(shift_y + k / (kRoot * kRoot));
    ShadowRay ray;
    if (aim_at_emitter(*point->light, point->position, x, y, ray)) {
      rays_.add(ray, point->light->bulbs);
      carried_.push_back(carried);
    } else {
      light_ += carried;
    }
  }
}

void LampScattering::add_unblocked() {
  const std::span<const std::uint8_t> blocked = rays_.blocked(lights_, tracer_);
  for (std::size_t i = 0; i < carried_.size(); ++i)
    if (blocked[i] == 0) light_ += carried_[i];
}

std::vector<dvec3> scatter_lamps(const FogRaysInput& input, const Fog& fog) {
  const RenderView& view = input.geometry.view;
  std::vector<dvec3> scattered(std::size_t{view.width} * view.height, dvec3(0.0));
  if (!(fog.density > 0.0f)) return scattered;
  const TwinLights lights = gather_lights(input.world, input.tracer);
  const std::vector<double> distances = fog_distances(input.geometry);
  const dvec3 camera = view.position - input.tracer.origin();
  std::mutex mutex;
  std::size_t done = 0;
  input.executor.parallel_for(view.height, 1, [&](JobRange rows) {
    LampScattering lamps(lights, input.tracer, fog, input.samples);
    for (auto y = static_cast<std::uint32_t>(rows.begin); y < rows.end; ++y) {
      for (std::uint32_t x = 0; x < view.width; ++x) {
        const std::size_t at = std::size_t{y} * view.width + x;
        scattered[at] =
            lamps.along(pixel_ray(input.geometry, x, y, distances[at], fog, camera), static_cast<std::uint32_t>(at));
      }
      if (!input.progress) continue;
      const std::lock_guard lock(mutex);
      input.progress(++done, view.height);
    }
  });
  return scattered;
}

std::vector<double> fog_distances(const GeometryPicture& geometry) {
  const RenderView& view = geometry.view;
  GLOAM_ASSERT(geometry.depth.size() == std::size_t{view.width} * view.height, "a depth a pixel");
  std::vector<double> distances(geometry.depth.size(), std::numeric_limits<double>::infinity());
  const dvec3 forward = view_forward(view);
  for (std::uint32_t y = 0; y < view.height; ++y)
    for (std::uint32_t x = 0; x < view.width; ++x) {
      const std::size_t at = std::size_t{y} * view.width + x;
      if (geometry.is_sky(at)) continue;
      const dvec3 position = geometry.position(x, y);
      distances[at] = view.camera.orthographic ? glm::dot(position, forward) : glm::length(position);
    }
  return distances;
}

}  // namespace gloam
