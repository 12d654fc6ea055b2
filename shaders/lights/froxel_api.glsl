// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTS_FROXEL_API_GLSL
#define GLOAM_SHADERS_LIGHTS_FROXEL_API_GLSL

#include "shaders/lights/lights_api.glsl"
#include "shaders/render/view_api.glsl"

// Which lights reach a froxel (the part of a pixel rectangle between two depths) or a point. Conservative: a light is only left out when
// shading certainly gets nothing from it, whatever the order in which a compiler rounds.
//
// The tests of Wronski 2017, "Cull that cone!", and of the FF XVI paper, listing 2. Epsilons nest: every light in range of a pixel's
// point touches the pixel's froxel of kAccurateEpsilon, and every light that touches that one touches the froxel of kApproxEpsilon.
// Rounding moves a position by about 1e-6 of its distance and a cosine by about 6e-7: far less than two neighbours differ.

const float kApproxEpsilon = 1e-4;
const float kAccurateEpsilon = 4e-5;
const float kPointEpsilon = 1e-6;

struct Froxel {
  vec3 corner[8];    // camera-relative
  vec3 center;
  float radius;      // of the sphere around the center that holds the corners, slack included
  mat3 view_axes;    // columns: the view's right, down and back
  vec3 view_center;  // box along the view's axes
  vec3 view_half;    // slack included
  float slack;       // metres by which the bounds are widened
  float epsilon;
};

// `first` and `last`: pixel corners. `nearest` and `farthest`: depth values (reversed Z), both > 0.
Froxel make_froxel(ViewConstants view, vec2 first, vec2 last, float nearest, float farthest, float epsilon) {
  Froxel f;
  f.view_axes = mat3(normalize(view.ray_dx.xyz), normalize(view.ray_dy.xyz), view.view_row_z.xyz);
  vec3 low = vec3(1e30), high = vec3(-1e30);
  float reach = 0.0;
  for (int i = 0; i < 8; ++i) {
    vec2 pixel = vec2((i & 1) != 0 ? last.x : first.x, (i & 2) != 0 ? last.y : first.y) - 0.5;
    vec3 p = relative_position(view, pixel, (i & 4) != 0 ? nearest : farthest);
    f.corner[i] = p;
    vec3 q = p * f.view_axes;
    low = min(low, q);
    high = max(high, q);
    vec3 size = abs(p);
    reach = max(reach, size.x + size.y + size.z);
  }
  f.epsilon = epsilon;
  f.slack = epsilon * reach + 1e-6;
  f.view_center = (low + high) * 0.5;
  f.view_half = (high - low) * 0.5 + f.slack;
  f.center = f.view_axes * f.view_center;
  float r2 = 0.0;
  for (int i = 0; i < 8; ++i) {
    vec3 v = f.corner[i] - f.center;
    r2 = max(r2, dot(v, v));
  }
  f.radius = sqrt(r2) + 2.0 * f.slack;
  return f;
}

// Sphere of a light's range against the froxel: its sphere first, then its box along the view's axes.
bool sphere_touches(vec3 position, float inverse_range_squared, Froxel f) {
  vec3 v = position - f.center;
  vec3 outside = max(abs(position * f.view_axes - f.view_center) - f.view_half, vec3(0.0));
  float beyond = max(length(v) - f.radius, 0.0);
  float d2 = max(dot(outside, outside), beyond * beyond);
  return d2 * inverse_range_squared <= 1.0 + f.epsilon;
}

// Cone of a spot, without its end, against the froxel. `cos_outer`: of the half angle; it is widened here.
bool cone_touches(vec3 position, vec3 direction, float cos_outer, Froxel f) {
  float cosine = max(cos_outer - 0.125 * f.epsilon, -1.0);
  float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  // The froxel's sphere. A cross product keeps the digits that the difference of two large squares would lose.
  vec3 v = f.center - position;
  float along = dot(v, direction);
  float across = length(cross(v, direction));
  float rounding = 1e-6 * (abs(along) + across);
  bool touches = cosine * across - along * sine <= f.radius + rounding && along >= -f.radius - rounding;
  // The froxel's corners in the spot's clip space: a square pyramid round the cone. One side must not have all of them outside.
  if (cos_outer < 0.5) return touches;
  vec3 side = normalize(abs(direction.y) < 0.7 ? vec3(direction.z, 0.0, -direction.x) : vec3(0.0, -direction.z, direction.y));
  vec3 up = cross(direction, side);
  float tangent = sine / cosine;
  vec4 least = vec4(1e30);
  float deepest = -1e30;
  for (int i = 0; i < 8; ++i) {
    vec3 q = f.corner[i] - position;
    float z = dot(q, direction);
    vec2 xy = vec2(dot(q, side), dot(q, up));
    least = min(least, vec4(xy, -xy) - tangent * z);
    deepest = max(deepest, z);
  }
  float slack = 2.0 * f.slack * (1.0 + tangent) + 2.0 * rounding;
  return touches && deepest >= -slack && max(max(least.x, least.y), max(least.z, least.w)) <= slack;
}

// Cosine of a spot's half angle, known to a few 1e-7; only for lights with a spot_scale.
float cos_outer_of(float spot_scale, float spot_offset) { return -spot_offset / spot_scale; }

bool touches(LocalLight light, Froxel f) {
  if (!sphere_touches(light.position, light.inverse_range_squared, f)) return false;
  return light.spot_scale == 0.0 || cone_touches(light.position, light.direction, cos_outer_of(light.spot_scale, light.spot_offset), f);
}

// Whether a light may give a camera-relative point any light: whenever local_illuminance is not 0, and hardly more often.
bool in_range(LocalLight light, vec3 point) {
  vec3 size = abs(point);
  float slack = kPointEpsilon * (size.x + size.y + size.z);
  vec3 offset = light.position - point;
  vec3 least = max(abs(offset) - slack, vec3(0.0));
  float inverse_distance = inversesqrt(max(dot(offset, offset), 1e-6));
  float cosine = -dot(offset, light.direction) * inverse_distance;
  float widened = cosine + kPointEpsilon + 2.0 * slack * inverse_distance;
  return dot(least, least) * light.inverse_range_squared <= 1.0 + 2.0 * kPointEpsilon &&
         widened * light.spot_scale + light.spot_offset > 0.0;
}

#endif
