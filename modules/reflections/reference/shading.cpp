// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/shading.h"

#include <algorithm>
#include <cmath>

namespace gloam {
namespace {

constexpr double kPiTwin = 3.14159265358979323846;

}  // namespace

TwinPoint twin_point(const dvec3& to_eye, const dvec3& normal, const dvec3& base_color, double metallic,
                     double roughness) {
  const double alpha = std::max(roughness * roughness, 1e-3);
  return {.normal = normal,
          .to_eye = to_eye,
          .diffuse = base_color * ((1.0 - metallic) / kPiTwin),
          .f0 = glm::mix(dvec3(0.04), base_color, metallic),
          .roughness = roughness,
          .alpha2 = alpha * alpha,
          .n_dot_v = std::max(glm::dot(normal, to_eye), 1e-3)};
}

dvec3 reflected_light(const TwinPoint& p, const dvec3& to_light, const dvec3& illuminance) {
  const double n_dot_l = std::clamp(glm::dot(p.normal, to_light), 0.0, 1.0);
  if (n_dot_l <= 0.0) return dvec3(0.0);
  const dvec3 sum = to_light + p.to_eye;
  const double length = std::max(glm::length(sum), 1e-3);  // 0 if to_light = -to_eye
  const double n_dot_h = std::clamp(glm::dot(p.normal, sum) / length, 0.0, 1.0);
  const double v_dot_h = std::min(0.5 * length, 1.0);  // |l + v| = 2 v·h
  const double f = n_dot_h * n_dot_h * (p.alpha2 - 1.0) + 1.0;
  const auto smith = [&](double cosine) { return std::sqrt(p.alpha2 + (1.0 - p.alpha2) * cosine * cosine); };
  const double visibility = 0.5 / (n_dot_l * smith(p.n_dot_v) + p.n_dot_v * smith(n_dot_l));
  const double specular = p.alpha2 / (kPiTwin * f * f) * visibility;
  const dvec3 fresnel = p.f0 + (1.0 - p.f0) * std::pow(1.0 - v_dot_h, 5.0);
  return illuminance * n_dot_l * (p.diffuse + fresnel * (specular - p.diffuse));
}

dvec3 sky_radiance(const SceneEnvironment& sky, const dvec3& direction) {
  const dvec3 end(direction.y >= 0.0 ? sky.sky_zenith : sky.sky_ground);
  return glm::mix(dvec3(sky.sky_horizon), end, std::sqrt(std::abs(direction.y)));
}

dvec3 hemisphere_radiance(const SceneEnvironment& sky, const dvec3& normal) {
  const dvec3 above = 0.5 * (dvec3(sky.sky_horizon) + dvec3(sky.sky_zenith));
  return glm::mix(dvec3(sky.sky_ground), above, 0.5 + 0.5 * normal.y);
}

dvec3 diffuse_ambient(const SceneEnvironment& sky, const TwinPoint& p) {
  return kPiTwin * p.diffuse * hemisphere_radiance(sky, p.normal);
}

dvec3 specular_share(const TwinPoint& p) {
  const dvec4 r = p.roughness * dvec4(-1.0, -0.0275, -0.572, 0.022) + dvec4(1.0, 0.0425, 1.04, -0.04);
  const double a = std::min(r.x * r.x, std::exp2(-9.28 * p.n_dot_v)) * r.x + r.y;
  return p.f0 * (-1.04 * a + r.z) + (1.04 * a + r.w);
}

dvec3 mirrored_radiance(const SceneEnvironment& sky, const TwinPoint& p) {
  const dvec3 mirrored = glm::reflect(-p.to_eye, p.normal);
  return glm::mix(sky_radiance(sky, mirrored), hemisphere_radiance(sky, p.normal), p.roughness);
}

}  // namespace gloam
