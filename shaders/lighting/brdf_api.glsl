// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_BRDF_API_GLSL
#define GLOAM_SHADERS_LIGHTING_BRDF_API_GLSL

#include "shaders/common/math.glsl"

// 1: no light and no pixel has a width, and shading spends nothing on them. A constant: devices that are processors run
// both sides of a condition.
layout(constant_id = 25) const uint kPlainHighlights = 0u;

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
  float normal_spread;  // of the pixel, see spread_distribution; 0: a point's
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

// A light with a width, as the surface's normals see it: slopes of normals about the half vector to its centre. The
// normals that mirror some point of the light to the eye fill an ellipse. Turning a normal by an angle turns its
// mirrored ray by twice the angle in the plane of incidence, and by 2 v·h times the angle across it: the ellipse is
// longer across the plane, the more so at grazing angles.
struct NormalEllipse {
  float slope2;   // square of the slope of the surface's normal
  vec2 parts2;    // of slope2: in the plane of incidence and across it
  vec2 axes2;     // squares of the ellipse's half axes in these directions; x <= y
  float radius2;  // of the disc of the same solid angle; 0: a point
};

// half_angle: apparent radius of the light in radians.
NormalEllipse normal_ellipse(float slope2, float in_plane2, float v_dot_h, float half_angle) {
  float c = max(v_dot_h, 1e-3);
  NormalEllipse e;
  e.slope2 = slope2;
  e.parts2.x = min(in_plane2, slope2);
  e.parts2.y = slope2 - e.parts2.x;
  e.axes2.x = 0.25 * half_angle * half_angle;
  e.radius2 = e.axes2.x / c;
  e.axes2.y = e.radius2 / c;
  return e;
}

// Distance of a point outside an ellipse from it, <= 0 inside. From the nearest point, axes² p / (t + axes²), the
// distance is t |p / (t + axes²)|. The step from the bound for t that each axis gives is Newton's on the inverse
// length, which is nearly linear in t: exact for circles, at most 10 % less at the ratio 2 of the axes, 40 % at 10.
float distance_from_ellipse(vec2 p, vec2 axes) {
  vec2 axes2 = axes * axes;
  vec2 bound = axes * p - axes2;
  float t = max(max(bound.x, bound.y), 0.0);
  vec2 weight = 1.0 / (t + axes2);
  vec2 q = axes * p * weight;
  float q2 = dot(q, q);
  t = max(t + q2 * (sqrt(q2) - 1.0) / max(dot(q * q, weight), 1e-30), 0.0);
  return t * length(p / (t + axes2));
}

// Mean of GGX's distribution of slopes, a² / (π (a² + s²)²) with a = alpha, over the slopes that mirror a light. Over a
// disc of radius r whose middle is at a distance d it is exactly
//   (1 - u / R) / (2 π r²), u = a² + d² - r², R² = u² + 4 r² a²:
// a stereographic projection turns the distribution into the area of a sphere, and the disc into a cap. For an ellipse
// of the half axes b < c and b c = r² the same form is used, with
//   u = a² + t² + 2 w t at a distance t outside; w² instead of r² in R², which follows the curvature of the outline;
//   u at the middle such that the mean is the exact 1 / (π sqrt((a² + b²) (a² + c²))).
// Where a is not much less than b, the ellipse counts as rounder and the distribution as narrower. The difference from
// the mean, over all slopes, is at most 6 % of the light at c = 1.7 b, 10 % at c = 3 b, 17 % at c = 14 b.
// No branches: devices that are processors run both sides of each.
float mean_distribution(float alpha2, NormalEllipse e) {
  vec2 axes2 = max(e.axes2, 1e-6 * alpha2);
  float longer = axes2.y - axes2.x;
  float rounder = 0.5 * alpha2 * longer / (longer + 0.5 * alpha2);
  axes2.x += rounder;
  alpha2 -= 0.5 * rounder;
  float radius2 = sqrt(axes2.x * axes2.y);
  float middle = sqrt((alpha2 + axes2.x) * (alpha2 + axes2.y));
  float middle_u = (middle - 2.0 * radius2) * sqrt((middle + radius2) / (axes2.x + axes2.y + alpha2));
  vec2 q2 = e.parts2 / axes2;
  float q = max(q2.x + q2.y, 1e-12);
  float t = distance_from_ellipse(sqrt(e.parts2), sqrt(axes2));
  float curved2 = (q2.x * axes2.y + q2.y * axes2.x) / q;
  float w2 = mix(radius2, curved2, min(q, radius2 / (radius2 + t * t)));
  float u = mix(middle_u, alpha2, min(q, 1.0)) + t * t + 2.0 * sqrt(w2) * t;
  float product = 4.0 * w2 * alpha2;
  float root = sqrt(u * u + product);
  return 0.5 * (u > 0.0 ? product / (root * (root + u)) : 1.0 - u / root) / (kPi * radius2);
}

// Distribution of slopes of a pixel whose normals' slopes spread like a Gaussian exp(-s² / spread). GGX as wide
// as both together would be wrong on both sides: its peak still falls between pixels, and its tails are those of a
// rough surface, which are seen far around a bright light. A share q of the light goes to a wide GGX, with the tails of
// the surface's own, and the rest to a core without tails:
//   q = a² / (a² + 1.5 spread)
//   core(s²) = 1 / (1 + exp((s² - r²) / t)) / (π t ln(1 + exp(r² / t)))
// which is nearly a Gaussian for a light that is a point, and for a disc of radius r the disc with an edge as wide as
// t / r. Both integrate to 1 over all slopes. The factors 1.5 make the peak right where a² is large, and within 2 %
// where it equals the spread. The factors of t make the core of a point as wide as the Gaussian and the edges of discs
// two thirds of that: the sum over pixels of no disc varies by more than 3 % with its place.
// Without a spread, q is 1 and the result is the light's mean alone.
// The core of an ellipse is that of its short axis, stretched along the long one as much as the second moments of
// ellipse and spread together are.
float spread_distribution(ShadingPoint p, NormalEllipse e) {
  float wide2 = p.alpha2 + 1.5 * p.normal_spread;
  float tails = p.alpha2 / wide2;
  float ggx = mean_distribution(wide2, e);
  float core2 = p.normal_spread + 1.5 * p.alpha2;
  float stretch2 = (e.axes2.y + 2.0 * core2) / (e.axes2.x + 2.0 * core2);
  float core_slope2 = e.parts2.x + e.parts2.y / stretch2;
  float t = sqrt(core2 * (0.71 * core2 + 0.3 * e.axes2.x));
  float edge = e.axes2.x / t;
  float core = inversesqrt(stretch2) /
               ((1.0 + exp(min((core_slope2 - e.axes2.x) / t, 80.0))) * kPi * t * (edge + log(1.0 + exp(-edge))));
  return mix(core, ggx, tails);
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
  if (kPlainHighlights == 0u && (p.normal_spread > 0.0 || half_angle > 0.0)) {
    // The half vector's part in the plane of incidence is along l - v, at right angles to l + v.
    float cos2 = max(n_dot_h * n_dot_h, 1e-6);
    float difference = n_dot_l_raw - p.n_dot_v_raw;
    float in_plane2 = difference * difference / (max(4.0 - sum2, 1e-6) * cos2);
    float slope2 = max(1.0 - n_dot_h * n_dot_h, 0.0) / cos2;
    NormalEllipse e = normal_ellipse(slope2, in_plane2, v_dot_h, half_angle);
    specular = 0.5 * spread_distribution(p, e) / (cos2 * cos2 * smith);
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

// Illuminance that light from behind leaves on the visible side, before the transmittance of the body: times `diffuse`
// it is the radiance, the same to all sides (Lambert). Of the light that falls on the far side, that side reflects the
// Fresnel term and then the albedo; the rest enters, and leaves tinted by the albedo. So albedo · (2 − albedo) ≤ 1 of
// it leaves the body, both sides together. A white body reflects all of it.
vec3 light_through(ShadingPoint p, vec3 to_light, vec3 illuminance) {
  float n_dot_l = clamp(-dot(p.normal, to_light), 0.0, 1.0);
  float one = 1.0 - n_dot_l;
  float one2 = one * one;
  vec3 fresnel = p.f0 + (1.0 - p.f0) * (one2 * one2 * one);
  return (illuminance * n_dot_l) * (1.0 - fresnel) * (1.0 - kPi * p.diffuse);
}

#endif
