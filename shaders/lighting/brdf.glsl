// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_BRDF_GLSL
#define GLOAM_SHADERS_LIGHTING_BRDF_GLSL

#include "shaders/common/math.glsl"

// The glTF 2.0 metallic-roughness BRDF (appendix B): GGX distribution, height-correlated Smith visibility, Schlick Fresnel.

struct ShadingPoint {
  vec3 position;   // camera-relative
  vec3 normal;
  vec3 to_eye;
  vec3 diffuse;    // (1 - metallic) · base colour / π
  vec3 f0;
  float alpha2;    // roughness⁴
  float n_dot_v;
};

ShadingPoint shading_point(vec3 position, vec3 to_eye, vec3 normal, vec3 base_color, float metallic, float roughness) {
  ShadingPoint p;
  p.position = position;
  p.normal = normal;
  p.to_eye = to_eye;
  p.diffuse = base_color * ((1.0 - metallic) / kPi);
  p.f0 = mix(vec3(0.04), base_color, metallic);
  float alpha = max(roughness * roughness, 1e-3);
  p.alpha2 = alpha * alpha;
  p.n_dot_v = max(dot(normal, to_eye), 1e-3);
  return p;
}

// Radiance towards the eye for an illuminance (on a plane facing the light) from a unit direction.
vec3 reflected(ShadingPoint p, vec3 to_light, vec3 illuminance) {
  float n_dot_l = clamp(dot(p.normal, to_light), 0.0, 1.0);
  vec3 sum = to_light + p.to_eye;
  vec3 half_vector = sum * inversesqrt(max(dot(sum, sum), 1e-12));  // a light straight behind the surface: not NaN
  float n_dot_h = clamp(dot(p.normal, half_vector), 0.0, 1.0);
  float v_dot_h = clamp(dot(p.to_eye, half_vector), 0.0, 1.0);
  float f = (n_dot_h * p.alpha2 - n_dot_h) * n_dot_h + 1.0;
  float distribution = p.alpha2 / (kPi * f * f);
  float visibility = 0.5 / (n_dot_l * sqrt(p.n_dot_v * (p.n_dot_v - p.n_dot_v * p.alpha2) + p.alpha2) +
                            p.n_dot_v * sqrt(n_dot_l * (n_dot_l - n_dot_l * p.alpha2) + p.alpha2));
  float one = 1.0 - v_dot_h;
  float schlick = one * one * one * one * one;
  vec3 fresnel = p.f0 + (1.0 - p.f0) * schlick;
  return illuminance * n_dot_l * ((1.0 - fresnel) * p.diffuse + fresnel * (distribution * visibility));
}

#endif
