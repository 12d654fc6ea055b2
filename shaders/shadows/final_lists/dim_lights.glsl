// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_DIM_LIGHTS_GLSL
#define GLOAM_SHADERS_SHADOWS_DIM_LIGHTS_GLSL

#include "shaders/common/math.glsl"
#include "shaders/lights/lights_api.glsl"
#include "shaders/shadows/final_lists/tile_bounds.glsl"

// Dim lights (shadows.min_contribution): a local light that can add at most FinalGrid::dim_light to any pixel of a
// tile, even without a shadow. All pixels of the tile get the mean visibility of a few of them, so the error of a pixel
// is at most the light's bound. The bounds of a tile's dim lights together are at most GLOAM_DIM_LIGHTS · dim_light:
// lights are taken in the order of the list while their sum fits. Include this after shadows_api.glsl.
//
// The bound encloses reflected_disc() and light_through() of shaders/lighting/brdf_api.glsl. Diffuse light counts in
// full, also where a part of the light is reflected, and materials as if they had no metallic part.

// Bounds of the materials of a tile's pixels.
struct TileMaterials {
  vec3 color;   // greatest base colour, by channel
  vec3 f0;      // at least the reflectance at normal incidence
  vec2 alpha2;  // least and greatest fourth power of the roughness, as in shading_point()
  bool spread;  // the normals of a pixel may spread (GBufferTexel::normal_spread)
};

float greatest(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

// Pixels of the sky count, too: what the geometry buffer holds there can only widen the bounds.
TileMaterials tile_materials(sampler2D base_color_image, sampler2D material_image, vec2 inverse_size, uvec2 tile) {
  vec2 roughness = vec2(1.0, 0.0);
  vec3 color = vec3(0.0);  // square roots, as the geometry buffer holds them
  float metallic = 0.0, spread = 0.0;
  for (int i = 0; i < GLOAM_SHADOW_TILE * GLOAM_SHADOW_TILE / 4; ++i) {
    vec2 corner = vec2(ivec2(tile) * GLOAM_SHADOW_TILE + 2 * ivec2(i & 3, i >> 2) + 1) * inverse_size;
    vec4 rough = textureGather(material_image, corner, 0), flags = textureGather(base_color_image, corner, 3);
    roughness = vec2(min(roughness.x, -greatest(-rough)), max(roughness.y, greatest(rough)));
    metallic = max(metallic, greatest(textureGather(material_image, corner, 1)));
    spread = max(spread, greatest(min(flags, 1.0 - flags)));
    color = max(color, vec3(greatest(textureGather(base_color_image, corner, 0)),
                            greatest(textureGather(base_color_image, corner, 1)),
                            greatest(textureGather(base_color_image, corner, 2))));
  }
  vec2 alpha = max(roughness * roughness, vec2(1e-3));
  color *= color;
  return TileMaterials(color, max(vec3(0.04), mix(vec3(0.04), color, metallic)), alpha * alpha, spread > 0.25 / 255.0);
}

// Length of the chord of a unit circle over an angle of at most 90° with this sine.
float chord(float sine) { return sine * sqrt(2.0 / (1.0 + sqrt(max(1.0 - sine * sine, 0.0)))); }

// Bounds of the dot products of two unit vectors that differ by at most these lengths from vectors with the dot product
// `middle`.
vec2 dot_bounds(float middle, float a, float b) {
  float off = a + b + a * b;
  return clamp(vec2(middle - off, middle + off), vec2(-1.0), vec2(1.0));
}

// Bound of the specular part of reflected_disc(), over the illuminance. n_l, n_v, l_v: least and greatest dot product
// of shading normal, direction to the light and direction to the eye. half_angle: at least the light's apparent radius.
//
// The distribution of normals falls with the slope of the half vector. For a light with a width it is a mean over the
// slopes that mirror the light, which are within half_angle / (2 v·h) of that slope. The forms that
// spread_distribution() uses for ellipses differ from the mean by up to 17 %, and the peak of its core is 1.14 times
// that of the surface's own distribution: kForms bounds both. Pixels with spread normals count as if the half vector
// were their normal. For a slope s and a light of the slope c, the distribution over cos⁴ is that of a point times
// ((1 + s²) / (alpha2 + (s - c)²))², which falls from the slope `peak` on.
vec3 most_specular(TileMaterials m, vec2 n_l, vec2 n_v, vec2 l_v, float half_angle) {
  const float kForms = 1.2;
  vec2 sums = sqrt(max(2.0 + 2.0 * l_v, vec2(1e-6)));
  float n_h_most = min((max(n_l.y, 0.0) + max(n_v.y, 0.0)) / sums.x, 1.0);
  float n_h_least = max((max(n_l.x, 0.0) + n_v.x) / sums.y, 0.0), v_h_least = 0.5 * sums.x;
  float cos2 = max(n_h_most * n_h_most, 1e-6), least_cos2 = max(n_h_least * n_h_least, 1e-6);
  float slope = sqrt(max(1.0 - cos2, 0.0) / cos2), of_light = 0.5 * half_angle / max(v_h_least, 1e-3);
  float light2 = of_light * of_light, k = 1.0 + light2 - m.alpha2.y;
  float peak = of_light + 2.0 * of_light * m.alpha2.y / max(k + sqrt(k * k + 4.0 * light2 * m.alpha2.y), 1e-9);
  float steepest = max(slope, peak), stretch = m.spread ? 1.0 / least_cos2 : 1.0 + steepest * steepest;
  float beside = m.spread ? 0.0 : max(slope - of_light, 0.0);
  float beside2 = beside * beside, alpha2 = clamp(beside2, m.alpha2.x, m.alpha2.y), wide = alpha2 + beside2;
  float distribution = kForms * alpha2 * stretch * stretch / (kPi * wide * wide);
  float eye = max(n_v.x, 1e-3);
  float one = 1.0 - min(v_h_least, 1.0), one2 = one * one;
  vec3 fresnel = m.f0 + (1.0 - m.f0) * (one2 * one2 * one);
  // n·l over the Smith term of reflected_disc() is at most 1 / (max(n·v, alpha) + n·v).
  return fresnel * (0.5 * distribution / (max(eye, sqrt(m.alpha2.x)) + eye));
}

// The greatest radiance · light_scale that the light can add to a pixel of the group, without shadows. emitter_m: its
// radius.
float most_light(ViewConstants view, TileBounds t, TileMaterials m, LocalLight l, float emitter_m) {
  const float slack = 1e-5;  // margin for rounding
  vec3 offset = l.position - t.center;
  float middle = length(offset), nearest = middle - t.radius, eye_distance = length(t.center);
  if (!(nearest > 1e-3 * middle)) return 1e30;
  float across = t.radius / middle;
  vec3 to_light = offset / middle;
  // Spot lights: the least angle between the axis and the directions to the pixels.
  float axis_cos = -dot(to_light, l.direction), axis_sin = sqrt(max(1.0 - axis_cos * axis_cos, 0.0));
  float across_cos = sqrt(max(1.0 - across * across, 0.0));
  float cone_cos = axis_cos >= across_cos ? 1.0 : axis_cos * across_cos + axis_sin * across;
  float cone = clamp((cone_cos + slack) * l.spot_scale + l.spot_offset, 0.0, 1.0);
  float window = range_window(nearest * nearest * l.inverse_range_squared);
  vec3 illuminance = l.color * (window * cone * cone / (nearest * nearest));
  bool orthographic = view.orthographic != 0u;
  vec3 to_eye = orthographic ? view.view_row_z.xyz : -t.center / max(eye_distance, 1e-30);
  float off_l = chord(across) + slack, off_n = t.shading_spread + slack;
  float off_v = (orthographic ? 0.0 : eye_distance > t.radius ? chord(t.radius / eye_distance) : 2.0) + slack;
  vec2 n_l = dot_bounds(dot(t.normal, to_light), off_n, off_l);
  // Near the plane of the pixels, the height of the light over it is the better bound.
  float height = dot(t.normal, l.position) - t.offsets.x;
  n_l.y = min(n_l.y, max(height, 0.0) / nearest + off_n);
  vec2 n_v = dot_bounds(dot(t.normal, to_eye), off_n, off_v), l_v = dot_bounds(dot(to_light, to_eye), off_l, off_v);
  vec3 specular = most_specular(m, n_l, n_v, l_v, min(emitter_m / nearest, 1.0));
  float diffuse = kTransmission != 0u && t.transmits ? 1.0 : max(n_l.y, 0.0);
  vec3 most = illuminance * (1.0 + slack) * (m.color * (diffuse / kPi) + (n_l.y > 0.0 ? specular : vec3(0.0)));
  return max(most.r, max(most.g, most.b));
}

#endif
