// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/scene/resources.h"
#include "modules/lights/components.h"

/// Expected results of shading, in double precision, written from the formulas alone.
namespace gloam::test {

struct OracleSurface {
  dvec3 position = dvec3(0.0);
  dvec3 normal = dvec3(0.0, 0.0, 1.0);
  dvec3 to_eye = dvec3(0.0, 0.0, 1.0);
  dvec3 base_color = dvec3(1.0);
  double metallic = 0.0;
  double roughness = 1.0;
};

struct OracleLight {
  Light light;
  dvec3 position = dvec3(0.0);
  dvec3 direction = dvec3(0.0, 0.0, -1.0);
};

inline constexpr double kPiOracle = 3.14159265358979323846;

/// glTF 2.0, appendix B: (1 − F) · c_diff / π + F · D · V, times cosine and illuminance.
[[nodiscard]] inline dvec3 oracle_reflected(const OracleSurface& s, const dvec3& to_light, const dvec3& illuminance) {
  const double nl = glm::dot(s.normal, to_light);
  const double nv = glm::dot(s.normal, s.to_eye);
  if (nl <= 0.0 || nv <= 0.0) return dvec3(0.0);
  const dvec3 half = glm::normalize(to_light + s.to_eye);
  const double nh = std::max(glm::dot(s.normal, half), 0.0);
  const double vh = std::max(glm::dot(s.to_eye, half), 0.0);
  const double alpha = s.roughness * s.roughness;
  const double a2 = alpha * alpha;
  const double d = a2 / (kPiOracle * std::pow(nh * nh * (a2 - 1.0) + 1.0, 2.0));
  const auto smith = [&](double x) { return std::sqrt(a2 + (1.0 - a2) * x * x); };
  const double v = 0.5 / (nl * smith(nv) + nv * smith(nl));
  const dvec3 f0 = glm::mix(dvec3(0.04), s.base_color, s.metallic);
  const dvec3 fresnel = f0 + (1.0 - f0) * std::pow(1.0 - vh, 5.0);
  const dvec3 diffuse = (1.0 - s.metallic) * s.base_color / kPiOracle;
  return illuminance * nl * ((1.0 - fresnel) * diffuse + fresnel * d * v);
}

/// A light that arrives at a point.
struct OracleArrival {
  dvec3 to_light = dvec3(0.0);
  dvec3 illuminance = dvec3(0.0);  ///< on a plane that faces the light
};

/// KHR_lights_punctual, with the window that ends a light at its range. Without a range it has no end. Nothing blocks
/// the light.
[[nodiscard]] inline OracleArrival oracle_arrival(const dvec3& position, const OracleLight& l) {
  const dvec3 color = dvec3(l.light.color) * static_cast<double>(l.light.intensity);
  if (l.light.kind == LightKind::directional) return {-l.direction, color};
  const dvec3 offset = l.position - position;
  const double distance = glm::length(offset);
  const dvec3 to_light = offset / distance;
  const double share = l.light.range_m > 0.0f ? distance / static_cast<double>(l.light.range_m) : 0.0;
  const double window = std::max(1.0 - std::pow(share, 4.0), 0.0);
  double cone = 1.0;
  if (l.light.kind == LightKind::spot) {
    const double outer = std::cos(static_cast<double>(l.light.outer_angle));
    const double inner = std::cos(static_cast<double>(l.light.inner_angle));
    const double ramp = (glm::dot(-to_light, l.direction) - outer) / std::max(inner - outer, 1e-3);
    cone = std::pow(std::clamp(ramp, 0.0, 1.0), 2.0);
  }
  return {to_light, color * (window * cone / (distance * distance))};
}

[[nodiscard]] inline dvec3 oracle_light(const OracleSurface& s, const OracleLight& l) {
  const OracleArrival arrival = oracle_arrival(s.position, l);
  return oracle_reflected(s, arrival.to_light, arrival.illuminance);
}

[[nodiscard]] inline dvec3 oracle_sky(const SceneEnvironment& sky, const dvec3& direction) {
  const dvec3 end = direction.y >= 0.0 ? dvec3(sky.sky_zenith) : dvec3(sky.sky_ground);
  return glm::mix(dvec3(sky.sky_horizon), end, std::sqrt(std::abs(direction.y)));
}

/// Mean radiance of the hemisphere around a normal.
[[nodiscard]] inline dvec3 oracle_hemisphere(const SceneEnvironment& sky, const dvec3& normal) {
  const dvec3 above = 0.5 * (dvec3(sky.sky_horizon) + dvec3(sky.sky_zenith));
  return glm::mix(dvec3(sky.sky_ground), above, 0.5 + 0.5 * normal.y);
}

/// The ambient term as its comment states it: a hemisphere for diffuse light, the fit of Karis 2014 for specular.
[[nodiscard]] inline dvec3 oracle_ambient(const OracleSurface& s, const SceneEnvironment& sky) {
  const dvec3 hemisphere = oracle_hemisphere(sky, s.normal);
  const double nv = glm::dot(s.normal, s.to_eye);
  const double r = s.roughness;
  const double rx = 1.0 - r, ry = 0.0425 - 0.0275 * r, rz = 1.04 - 0.572 * r, rw = 0.022 * r - 0.04;
  const double a = std::min(rx * rx, std::exp2(-9.28 * nv)) * rx + ry;
  const dvec3 f0 = glm::mix(dvec3(0.04), s.base_color, s.metallic);
  const dvec3 mirrored = 2.0 * nv * s.normal - s.to_eye;
  const dvec3 specular = (f0 * (-1.04 * a + rz) + (1.04 * a + rw)) * glm::mix(oracle_sky(sky, mirrored), hemisphere, r);
  return (1.0 - s.metallic) * s.base_color * hemisphere + specular;
}

[[nodiscard]] inline dvec3 oracle_shade(const OracleSurface& s, const std::vector<OracleLight>& lights,
                                        const SceneEnvironment& sky) {
  dvec3 sum = oracle_ambient(s, sky);
  for (const OracleLight& light : lights) sum += oracle_light(s, light);
  return sum;
}

}  // namespace gloam::test
