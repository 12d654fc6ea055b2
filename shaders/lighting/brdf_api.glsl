// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_BRDF_API_GLSL
#define GLOAM_SHADERS_LIGHTING_BRDF_API_GLSL

#include "shaders/common/math.glsl"

// The glTF 2.0 metallic-roughness BRDF (appendix B): GGX distribution, height-correlated Smith visibility, Schlick
// Fresnel.

struct ShadingPoint {
  vec3 position;  // camera-relative
  vec3 normal;
  vec3 to_eye;
  vec3 diffuse;  // (1 - metallic) · base colour / π
  vec3 f0;
  float alpha2;   // roughness⁴
  float n_dot_v;  // > 0
  float n_dot_v_raw;
  float smith_v;        // the part of the Smith visibility term that does not depend on the light
  float normal_spread;  // of the pixel, see spread_highlight; 0: a point's
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
  p.n_dot_v_raw = dot(normal, to_eye);
  p.n_dot_v = max(p.n_dot_v_raw, 1e-3);
  p.smith_v = sqrt(p.n_dot_v * (p.n_dot_v - p.n_dot_v * p.alpha2) + p.alpha2);
  p.normal_spread = 0.0;
  return p;
}

// The slopes of half vectors to a light of this apparent radius fill a disc of the square of the radius
// half_angle / (2 sqrt(v·h)), of the same solid angle.
float half_vector_radius2(float v_dot_h, float half_angle) {
  return 0.25 * half_angle * half_angle / max(v_dot_h, 1e-3);
}

// Factor on the GGX distribution of a light whose half vectors' slopes fill a disc of radius r. Each slope gets the
// distribution at the slope that is nearer to the normal by a shift s, over the integral of that over all slopes, so
// that it adds no light: with a = alpha, the integral is (a² + π/2 a s + s²) / a². The s for which it is (a² + r²) / a²
// also makes the middle of the highlight as bright as the mean of the distribution over the disc. A mirror then shows
// the disc with its luminance, and a rough surface hardly changes.
float disc_highlight(float alpha2, float slope, float radius2) {
  float part = 0.25 * kPi * sqrt(alpha2);
  float shift = radius2 / (sqrt(part * part + radius2) + part);
  float nearest = max(slope - shift, 0.0);
  float fall = (alpha2 + slope * slope) / (alpha2 + nearest * nearest);
  return fall * fall * alpha2 / (alpha2 + radius2);
}

// Distribution of half vectors of a pixel whose normals' slopes spread like a Gaussian exp(-s² / spread). GGX as wide
// as both together would be wrong on both sides: its peak still falls between pixels, and its tails are those of a
// rough surface, which are seen far around a bright light. A share q of the light goes to a wide GGX, with the tails of
// the surface's own, and the rest to a core without tails:
//   q = a² / (a² + 1.5 spread)
//   core(s²) = 1 / (1 + exp((s² - r²) / t)) / (π t ln(1 + exp(r² / t)))
// which is nearly a Gaussian for a light that is a point, and for a disc of radius r the disc with an edge as wide as
// t / r. Both integrate to 1 over all slopes. The factors 1.5 make the peak right where a² is large, and within 2 %
// where it equals the spread. The factors of t make the core of a point as wide as the Gaussian and the edges of discs
// two thirds of that: the sum over pixels of no disc varies by more than 3 % with its place.
float spread_distribution(ShadingPoint p, float n_dot_h, float radius2) {
  float cos2 = max(n_dot_h * n_dot_h, 1e-6);
  float slope2 = max(1.0 - cos2, 0.0) / cos2;
  float wide2 = p.alpha2 + 1.5 * p.normal_spread;
  float tails = p.alpha2 / wide2;
  float fall = wide2 + slope2;
  float ggx = wide2 / (kPi * fall * fall) * (radius2 > 0.0 ? disc_highlight(wide2, sqrt(slope2), radius2) : 1.0);
  float core2 = p.normal_spread + 1.5 * p.alpha2;
  float t = sqrt(core2 * (0.71 * core2 + 0.3 * radius2));
  float edge = radius2 / t;
  float core = 1.0 / ((1.0 + exp(min((slope2 - radius2) / t, 80.0))) * kPi * t * (edge + log(1.0 + exp(-edge))));
  return mix(core, ggx, tails) / (cos2 * cos2);
}

// Radiance toward the eye for an illuminance (on a plane that faces the light) from the unit direction `to_light`. For
// unit l and v: h = (l + v) / |l + v| and |l + v|² = 2 + 2 l·v. Dot products with h therefore do not need the vector h.
// half_angle: apparent radius of the light in radians; 0: a point.
vec3 reflected_disc(ShadingPoint p, vec3 to_light, vec3 illuminance, float half_angle) {
  float n_dot_l_raw = dot(p.normal, to_light);
  float n_dot_l = clamp(n_dot_l_raw, 0.0, 1.0);
  float sum2 = max(2.0 + 2.0 * dot(to_light, p.to_eye), 1e-6);  // no NaN if to_light = -to_eye
  float inverse_sum = inversesqrt(sum2);
  float n_dot_h = clamp((n_dot_l_raw + p.n_dot_v_raw) * inverse_sum, 0.0, 1.0);
  float v_dot_h = min(0.5 * sum2 * inverse_sum, 1.0);
  float f = (n_dot_h * p.alpha2 - n_dot_h) * n_dot_h + 1.0;
  float smith = n_dot_l * p.smith_v + p.n_dot_v * sqrt(n_dot_l * (n_dot_l - n_dot_l * p.alpha2) + p.alpha2);
  float specular = 0.5 * p.alpha2 / (kPi * f * f * smith);  // distribution · visibility
  float radius2 = half_vector_radius2(v_dot_h, half_angle);
  if (p.normal_spread > 0.0) {
    specular = 0.5 * spread_distribution(p, n_dot_h, radius2) / smith;
  } else if (half_angle > 0.0) {
    float slope = sqrt(max(1.0 - n_dot_h * n_dot_h, 0.0)) / max(n_dot_h, 1e-3);
    specular *= disc_highlight(p.alpha2, slope, radius2);
  }
  float one = 1.0 - v_dot_h;
  float one2 = one * one;
  vec3 fresnel = p.f0 + (1.0 - p.f0) * (one2 * one2 * one);
  return (illuminance * n_dot_l) * (p.diffuse + fresnel * (specular - p.diffuse));
}

// The same for a point.
vec3 reflected(ShadingPoint p, vec3 to_light, vec3 illuminance) {
  return reflected_disc(p, to_light, illuminance, 0.0);
}

#endif
