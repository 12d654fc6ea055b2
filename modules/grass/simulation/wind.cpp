// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/simulation/wind.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/vector_double2.hpp>

#include "engine/ecs/world.h"

namespace gloam {
namespace {

using glm::dvec2;

constexpr double kPeriod = GLOAM_GRASS_WIND_PERIOD;

double finite_or_zero(double x) { return std::isnan(x) ? 0.0 : std::clamp(x, -1e30, 1e30); }

double in_period(double x) {
  if (!std::isfinite(x)) return 0.0;
  const double phase = x - kPeriod * std::floor(x / kPeriod);
  return phase >= 0.0 && phase < kPeriod ? phase : 0.0;
}

std::uint32_t hash(std::uint32_t x, std::uint32_t z, std::uint32_t octave) {
  std::uint32_t h = x * 0x9E3779B1u ^ z * 0x85EBCA77u ^ octave * 0xC2B2AE3Du;
  h = (h ^ h >> 15) * 0x2C1B3C6Du;
  h = (h ^ h >> 12) * 0x297A2D39u;
  return h ^ h >> 15;
}

dvec2 lattice(std::int64_t x, std::int64_t z, std::int64_t cells, std::uint32_t octave) {
  const std::uint32_t h =
      hash(static_cast<std::uint32_t>(x & (cells - 1)), static_cast<std::uint32_t>(z & (cells - 1)), octave);
  return dvec2(h & 0xFFFFu, h >> 16) * (2.0 / 65535.0) - 1.0;
}

dvec2 noise(dvec2 at, std::int64_t cells, std::uint32_t octave) {
  const dvec2 corner(std::floor(at.x), std::floor(at.y));
  dvec2 t = at - corner;
  t = t * t * (3.0 - 2.0 * t);
  const auto x = static_cast<std::int64_t>(corner.x);
  const auto z = static_cast<std::int64_t>(corner.y);
  const dvec2 near = lattice(x, z, cells, octave) * (1.0 - t.x) + lattice(x + 1, z, cells, octave) * t.x;
  const dvec2 far = lattice(x, z + 1, cells, octave) * (1.0 - t.x) + lattice(x + 1, z + 1, cells, octave) * t.x;
  return near * (1.0 - t.y) + far * t.y;
}

}  // namespace

WindField wind_at_step(const Wind* wind, std::uint32_t step, double step_s) {
  WindField field;
  if (wind == nullptr) return field;
  for (int i = 0; i < 3; ++i) field.velocity[i] = finite_or_zero(static_cast<double>(wind->velocity[i]));
  const double speed = glm::length(field.velocity);
  if (speed > kGreatestWind) field.velocity *= kGreatestWind / speed;
  field.gust = std::clamp(finite_or_zero(static_cast<double>(wind->gust)), 0.0, 1.0);
  for (int i = 0; i < 3; ++i) field.drift[i] = in_period(field.velocity[i] * step_s * step);
  return field;
}

dvec3 wind_velocity(const WindField& wind, dvec3 at) {
  constexpr std::int64_t kCells = static_cast<std::int64_t>(kPeriod) / 8;
  const dvec2 p = dvec2(at.x - wind.drift.x, at.z - wind.drift.z) / 8.0;
  const dvec2 gust = (noise(p, kCells, 0) * 2.0 + noise(p * 4.0, kCells * 4, 1)) * (wind.gust / 3.0);
  const dvec3 side(wind.velocity.z, 0.0, -wind.velocity.x);
  return wind.velocity * (1.0 + 1.5 * gust.x) + side * (0.75 * gust.y);
}

dvec3 wind_position(dvec3 world) { return {in_period(world.x), in_period(world.y), in_period(world.z)}; }

shaders::GrassWind to_shader(const WindField& wind) {
  return {vec3(wind.velocity), static_cast<float>(wind.gust), vec3(wind.drift)};
}

WindField from_shader(const shaders::GrassWind& wind) {
  return {dvec3(wind.velocity), static_cast<double>(wind.gust), dvec3(wind.drift)};
}

}  // namespace gloam
