// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/shading.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/vector_double2.hpp>

namespace gloam {
namespace {

constexpr double kPiTwin = 3.14159265358979323846;

/// Slopes of normals that mirror a light with a width to the eye: twin of NormalEllipse.
struct TwinEllipse {
  glm::dvec2 parts2;  ///< of the squared slope of the surface's normal, along the axes
  glm::dvec2 axes2;   ///< squares of the half axes, x <= y
};

/// Distance of a point outside an ellipse from it, <= 0 inside: twin of distance_from_ellipse().
double twin_distance_from_ellipse(const glm::dvec2& p, const glm::dvec2& axes) {
  const glm::dvec2 axes2 = axes * axes, bound = axes * p - axes2;
  double t = std::max({bound.x, bound.y, 0.0});
  const glm::dvec2 weight = 1.0 / (t + axes2), q = axes * p * weight;
  const double q2 = glm::dot(q, q);
  t = std::max(t + q2 * (std::sqrt(q2) - 1.0) / std::max(glm::dot(q * q, weight), 1e-30), 0.0);
  return t * glm::length(p / (t + axes2));
}

/// Mean of the distribution of slopes over a light: twin of mean_distribution(), which derives it.
double twin_mean_distribution(double alpha2, const TwinEllipse& e) {
  glm::dvec2 axes2 = glm::max(e.axes2, 1e-6 * alpha2);
  const double longer = axes2.y - axes2.x;
  const double rounder = 0.5 * alpha2 * longer / (longer + 0.5 * alpha2);
  axes2.x += rounder;
  alpha2 -= 0.5 * rounder;
  const double radius2 = std::sqrt(axes2.x * axes2.y);
  const double middle = std::sqrt((alpha2 + axes2.x) * (alpha2 + axes2.y));
  const double middle_u = (middle - 2.0 * radius2) * std::sqrt((middle + radius2) / (axes2.x + axes2.y + alpha2));
  const glm::dvec2 q2 = e.parts2 / axes2;
  const double q = std::max(q2.x + q2.y, 1e-12);
  const double t = twin_distance_from_ellipse(glm::sqrt(e.parts2), glm::sqrt(axes2));
  const double curved2 = (q2.x * axes2.y + q2.y * axes2.x) / q;
  const double w2 = std::lerp(radius2, curved2, std::min(q, radius2 / (radius2 + t * t)));
  const double u = std::lerp(middle_u, alpha2, std::min(q, 1.0)) + t * t + 2.0 * std::sqrt(w2) * t;
  const double product = 4.0 * w2 * alpha2, root = std::sqrt(u * u + product);
  return 0.5 * (u > 0.0 ? product / (root * (root + u)) : 1.0 - u / root) / (kPiTwin * radius2);
}

/// GGX's distribution at a half vector, or its mean over the half vectors of a light with a width.
double distribution_of(const TwinPoint& p, const dvec3& to_light, double n_dot_h, double v_dot_h, double half_angle) {
  if (!(half_angle > 0.0)) {
    const double f = n_dot_h * n_dot_h * (p.alpha2 - 1.0) + 1.0;
    return p.alpha2 / (kPiTwin * f * f);
  }
  const double cos2 = std::max(n_dot_h * n_dot_h, 1e-6), slope2 = std::max(1.0 - n_dot_h * n_dot_h, 0.0) / cos2;
  // The half vector's part in the plane of incidence is along l - v, at right angles to l + v.
  const dvec3 across = to_light - p.to_eye;
  const double difference = glm::dot(p.normal, across);
  const double in_plane2 =
      std::min(difference * difference / (std::max(glm::dot(across, across), 1e-6) * cos2), slope2);
  const double c = std::max(v_dot_h, 1e-3), radius2 = 0.25 * half_angle * half_angle;
  return twin_mean_distribution(p.alpha2, {{in_plane2, slope2 - in_plane2}, {radius2, radius2 / (c * c)}}) /
         (cos2 * cos2);
}

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

dvec3 reflected_light(const TwinPoint& p, const dvec3& to_light, const dvec3& illuminance, double half_angle) {
  const double n_dot_l = std::clamp(glm::dot(p.normal, to_light), 0.0, 1.0);
  if (n_dot_l <= 0.0) return dvec3(0.0);
  const dvec3 sum = to_light + p.to_eye;
  const double length = std::max(glm::length(sum), 1e-3);  // 0 if to_light = -to_eye
  const double n_dot_h = std::clamp(glm::dot(p.normal, sum) / length, 0.0, 1.0);
  const double v_dot_h = std::min(0.5 * length, 1.0);  // |l + v| = 2 v·h
  const auto smith = [&](double cosine) { return std::sqrt(p.alpha2 + (1.0 - p.alpha2) * cosine * cosine); };
  const double visibility = 0.5 / (n_dot_l * smith(p.n_dot_v) + p.n_dot_v * smith(n_dot_l));
  const double specular = distribution_of(p, to_light, n_dot_h, v_dot_h, half_angle) * visibility;
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
