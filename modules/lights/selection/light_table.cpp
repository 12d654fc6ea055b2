// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/selection/light_table.h"

#include <algorithm>
#include <cmath>

#include "engine/math/finite.h"
#include "modules/lights/selection/light_list.h"

namespace gloam {
namespace {

constexpr float kMostColor = 1e20f;  // candela or lux: limit that keeps shading results finite in floats
constexpr double kRightAngle = 3.14159265358979323846 / 2;
/// A spot's bound grows by this share: its axis and cosine are rounded to floats, so a lit pixel may lie outside the
/// exact cone by as much.
constexpr double kSpotRounding = 1e-6;

float brightest_channel(const Light& light) {
  return light.intensity * std::max({light.color.r, light.color.g, light.color.b, 0.0f});
}

/// False for lights that emit nothing and for lights made unusable by NaN or infinity.
bool shines(const Light& light) {
  if (!is_finite(light.color) || !std::isfinite(light.intensity) || !(brightest_channel(light) > 0.0f)) return false;
  if (light.kind == LightKind::directional) return std::isfinite(light.apparent_angle);
  return light.kind != LightKind::spot || (std::isfinite(light.inner_angle) && std::isfinite(light.outer_angle));
}

/// Smallest sphere around a spherical sector of range 1: for a narrow cone it passes through apex and rim, for a wide
/// one the rim is its great circle.
void set_spot(const Light& light, LightRecord& record) {
  const double angle = std::clamp<double>(light.outer_angle, 0.0, kRightAngle);
  const double cosine = std::cos(angle);
  const bool wide = angle > kRightAngle / 2;
  record.inner_angle = light.inner_angle;
  record.outer_angle = light.outer_angle;
  record.ramp = spot_ramp(light);
  record.cos_outer = static_cast<float>(cosine);
  record.center_per_range = static_cast<float>(wide ? cosine : 0.5 / cosine);
  record.radius_per_range = static_cast<float>((wide ? std::sin(angle) : 0.5 / cosine) * (1.0 + kSpotRounding));
}

bool is_spot_of(const LightRecord& record, const Light& light) {
  return record.cos_outer >= 0.0f && record.inner_angle == light.inner_angle && record.outer_angle == light.outer_angle;
}

}  // namespace

void LightTable::resize(std::size_t count) {
  x.resize(count);
  y.resize(count);
  z.resize(count);
  radius.resize(count, kGivesNothing);
  along.resize(count);
  records.resize(count);
}

void LightTable::copy(std::size_t i, const LightTable& from, std::size_t j) {
  x[i] = from.x[j];
  y[i] = from.y[j];
  z[i] = from.z[j];
  radius[i] = from.radius[j];
  along[i] = from.along[j];
  records[i] = from.records[j];
}

void LightTable::set_light(std::size_t i, const PlacedLight& placed) {
  const Light& light = placed.light;
  LightRecord& record = records[i];
  record.entity = placed.entity;
  along[i] = 0.0f;
  radius[i] = kGivesNothing;
  if (!shines(light)) return;
  record.brightness = std::min(brightest_channel(light), kMostColor);
  // Removes negative channels and values too large for shading.
  record.color = glm::clamp(light.color * light.intensity, vec3(0.0f), vec3(kMostColor));
  const float width = light.kind == LightKind::directional ? light.apparent_angle : light.width_m;
  record.emitter_radius_m = width > 0.0f && std::isfinite(width) ? 0.5f * width : 0.0f;
  if (light.kind == LightKind::directional) {
    radius[i] = kDirectionalLight;
    return;
  }
  if (light.kind != LightKind::spot) {
    record.ramp = vec2(0.0f, 1.0f);
    record.cos_outer = -1.0f;
    record.center_per_range = 0.0f;
    record.radius_per_range = 1.0f;
  } else if (!is_spot_of(record, light)) {
    set_spot(light, record);  // reached only if the angles changed: a flickering light recomputes no sines
  }
  record.range_m = effective_range(light);
  record.inverse_range_squared = 1.0f / (record.range_m * record.range_m);
  along[i] = record.range_m * record.center_per_range;
  radius[i] = record.range_m * record.radius_per_range;
}

}  // namespace gloam
