// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTS_FROXEL_API_GLSL
#define GLOAM_SHADERS_LIGHTS_FROXEL_API_GLSL

#include "shaders/lights/lights_api.glsl"
#include "shaders/render/view_api.glsl"

// Conservative tests of lights against a froxel (the part of a pixel rectangle between two depths) or a point. A light
// is rejected only if shading certainly gets nothing from it, for any order of rounding a compiler may choose.
//
// The tests are from Wronski 2017, "Cull that cone!", and from the FF XVI paper, listing 2. The epsilons nest: every
// light in range of a pixel's point touches the pixel's froxel with kAccurateEpsilon, and every light that touches that
// froxel also touches it with kApproxEpsilon. Rounding moves a position by about 1e-6 of its distance and a cosine by
// about 6e-7, far less than the differences between consecutive epsilons.

const float kApproxEpsilon = 1e-4;
const float kAccurateEpsilon = 4e-5;
const float kPointEpsilon = 1e-6;

// In view axes: x right, y down, z back, camera at the origin. A truncated pyramid: two rectangles at two depths.
struct Froxel {
  mat3 view_axes;  // columns: camera-relative unit vectors
  vec4 nearest;    // rectangle: min x, min y, max x, max y
  vec4 farthest;
  float nearest_z;  // z of the two rectangles, not positive
  float farthest_z;
  vec3 center;       // of the bounding box
  vec3 half_extent;  // of the bounding box, including slack
  float radius;      // of the sphere around `center` that holds the froxel's corners, including slack
  float slack;       // metres by which the bounds are widened
  float epsilon;
};

// Rectangle (min x, min y, max x, max y) and z of the pixel rectangle at a depth value.
void froxel_end(ViewConstants view, mat3 axes, vec2 first, vec2 last, float depth, out vec4 rect, out float z) {
  vec3 a = relative_position(view, first - 0.5, depth) * axes;
  vec3 b = relative_position(view, last - 0.5, depth) * axes;
  rect = vec4(min(a.xy, b.xy), max(a.xy, b.xy));
  z = a.z;
}

float corner_distance(Froxel f, vec4 rect, float z) {
  vec2 side = max(abs(rect.xy - f.center.xy), abs(rect.zw - f.center.xy));
  return length(vec3(side, z - f.center.z));
}

// `first`, `last`: pixel corners. `nearest`, `farthest`: depth values (reversed Z), both > 0.
Froxel make_froxel(ViewConstants view, vec2 first, vec2 last, float nearest, float farthest, float epsilon) {
  Froxel f;
  f.view_axes = mat3(normalize(view.ray_dx.xyz), normalize(view.ray_dy.xyz), view.view_row_z.xyz);
  froxel_end(view, f.view_axes, first, last, nearest, f.nearest, f.nearest_z);
  froxel_end(view, f.view_axes, first, last, farthest, f.farthest, f.farthest_z);
  vec3 low = vec3(min(f.nearest.xy, f.farthest.xy), min(f.nearest_z, f.farthest_z));
  vec3 high = vec3(max(f.nearest.zw, f.farthest.zw), max(f.nearest_z, f.farthest_z));
  vec3 reach = max(abs(low), abs(high));
  f.epsilon = epsilon;
  f.slack = epsilon * (reach.x + reach.y + reach.z) + 1e-6;
  f.center = (low + high) * 0.5;
  f.half_extent = (high - low) * 0.5 + f.slack;
  f.radius =
      max(corner_distance(f, f.nearest, f.nearest_z), corner_distance(f, f.farthest, f.farthest_z)) + 2.0 * f.slack;
  return f;
}

// Sphere of a light's range against the froxel's bounding sphere and bounding box. `position`: in view axes.
bool sphere_touches(vec3 position, float inverse_range_squared, Froxel f) {
  vec3 v = position - f.center;
  vec3 outside = max(abs(v) - f.half_extent, vec3(0.0));
  float beyond = max(length(v) - f.radius, 0.0);
  return max(dot(outside, outside), beyond * beyond) * inverse_range_squared <= 1.0 + f.epsilon;
}

// The froxel's greatest coordinate along an axis.
float extent_along(Froxel f, vec3 axis) {
  vec4 a = axis.xyxy * f.nearest;
  vec4 b = axis.xyxy * f.farthest;
  return max(max(a.x, a.z) + max(a.y, a.w) + axis.z * f.nearest_z,
             max(b.x, b.z) + max(b.y, b.w) + axis.z * f.farthest_z);
}

// A spot's infinite cone against the froxel. `position`, `direction`: in view axes. `cos_outer`: cosine of the half
// angle; widened here.
bool cone_touches(vec3 position, vec3 direction, float cos_outer, Froxel f) {
  float cosine = max(cos_outer - 0.125 * f.epsilon, -1.0);
  float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  // Test of the froxel's bounding sphere. The cross product keeps digits that the difference of two large squares would
  // lose.
  vec3 v = f.center - position;
  float along = dot(v, direction);
  float across = length(cross(v, direction));
  float rounding = 1e-6 * (abs(along) + across);
  bool touches = cosine * across - along * sine <= f.radius + rounding && along >= -f.radius - rounding;
  // Test of the froxel's corners against the spot's clip space, a square pyramid around the cone: the froxel is
  // rejected if all corners lie outside one side. Not for cones over 120°.
  vec3 side =
      normalize(abs(direction.y) < 0.7 ? vec3(direction.z, 0.0, -direction.x) : vec3(0.0, -direction.z, direction.y));
  vec3 up = cross(direction, side);
  vec3 inward = direction * sine;
  side *= cosine;
  up *= cosine;
  vec4 inside = vec4(extent_along(f, inward + side), extent_along(f, inward - side), extent_along(f, inward + up),
                     extent_along(f, inward - up)) -
                (dot(inward, position) + vec4(1.0, -1.0, 0.0, 0.0) * dot(side, position) +
                 vec4(0.0, 0.0, 1.0, -1.0) * dot(up, position));
  float least =
      min(min(min(inside.x, inside.y), min(inside.z, inside.w)), extent_along(f, direction) - dot(direction, position));
  float slack = 4.0 * f.slack + 4.0 * rounding;
  return touches && (cos_outer < 0.5 || least >= -slack);
}

// A spot's cone against the froxel; true for a point light.
bool cone_touches(LocalLight light, Froxel f) {
  // Recovers the cosine of the half angle, accurate to a few 1e-7.
  return light.spot_scale == 0.0 || cone_touches(light.position * f.view_axes, light.direction * f.view_axes,
                                                 -light.spot_offset / light.spot_scale, f);
}

bool touches(LocalLight light, Froxel f) {
  return sphere_touches(light.position * f.view_axes, light.inverse_range_squared, f) && cone_touches(light, f);
}

// Bound, in metres, of how far rounding moves a camera-relative point.
float point_slack(vec3 point) { return kPointEpsilon * dot(abs(point), vec3(1.0)); }

// Whether a light may light a camera-relative point: true whenever local_illuminance is not 0, and rarely otherwise.
// False for a point at infinity (1e30).
bool in_range(LocalLight light, vec3 point, float slack) {
  vec3 offset = light.position - point;
  vec3 least = max(abs(offset) - slack, vec3(0.0));
  float inverse_distance = inversesqrt(max(dot(offset, offset), 1e-30));
  float cosine = kPointEpsilon + (2.0 * slack - dot(offset, light.direction)) * inverse_distance;
  float inside = 1.0 + 2.0 * kPointEpsilon - dot(least, least) * light.inverse_range_squared;
  return min(inside, cosine * light.spot_scale + light.spot_offset) > 0.0;
}

bool in_range(LocalLight light, vec3 point) { return in_range(light, point, point_slack(point)); }

#endif
