// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_REFLECTIONS_SCREEN_SPACE_MARCH_GLSL
#define GLOAM_SHADERS_REFLECTIONS_SCREEN_SPACE_MARCH_GLSL

#include "shaders/render/view_api.glsl"

// Rays through the depth image. A ray is followed up to `reach_m` above its origin, to the border of the screen and to
// the near plane. Include this after the uniforms `view` and `reflection` and the images depth_image and depth_bounds.

// A ray on the screen. Position and reversed depth are linear in s, 0 at the origin and 1 at the end.
struct ScreenRay {
  vec3 from;  // pixels, reversed depth
  vec3 step;  // to the end
  float w0;   // clip w at the origin and at the end
  float w1;
  float length_m;  // of the ray; 0: nothing to follow
};

vec3 on_screen(vec4 clip) {
  vec2 ndc = clip.xy / clip.w;
  return vec3((0.5 + ndc * vec2(0.5, -0.5)) * vec2(view.size), clip.z / clip.w);
}

// Length until a border where the clip-space distance f0 + t fd becomes negative.
float until(float f0, float fd, float most) { return fd < 0.0 ? min(most, max(f0, 0.0) / -fd) : most; }

ScreenRay screen_ray(vec3 origin, vec3 direction) {
  vec4 at = view.clip_from_relative * vec4(origin, 1.0), along = view.clip_from_relative * vec4(direction, 0.0);
  float length_m = reflection.reach_m / max(direction.y, 1e-4);
  length_m = until(at.w - at.x, along.w - along.x, length_m);
  length_m = until(at.w + at.x, along.w + along.x, length_m);
  length_m = until(at.w - at.y, along.w - along.y, length_m);
  length_m = until(at.w + at.y, along.w + along.y, length_m);
  float depth_m = view_depth(view, origin), faster_m = view_depth(view, direction);
  length_m = until(depth_m - view.near_m, faster_m, length_m);
  ScreenRay ray;
  vec4 end = at + along * length_m;
  ray.from = on_screen(at);
  ray.step = on_screen(end) - ray.from;
  ray.w0 = at.w;
  ray.w1 = end.w;
  ray.length_m = at.w > 0.0 && end.w > 0.0 ? length_m : 0.0;
  return ray;
}

// Distance in metres along the ray at s.
float distance_at(ScreenRay ray, float s) { return ray.length_m * (s * ray.w0 / max(mix(ray.w1, ray.w0, s), 1e-30)); }
// The inverse of distance_at, as a share of the length.
float place_of(ScreenRay ray, float share) { return share * ray.w1 / max(mix(ray.w0, ray.w1, share), 1e-30); }

#ifdef GLOAM_BLENDED_LAYER
bool through_blended = false;  // rays are followed through BlendedLayer, not through opaque surfaces
#endif

float depth_under(vec2 pixel) {
  ivec2 at = clamp(ivec2(pixel), ivec2(0), ivec2(view.size) - 1);
#ifdef GLOAM_BLENDED_LAYER
  // Mean depth of the blended surfaces, weighted by their opacity.
  float opacity = texelFetch(blended_light, at, 0).a;
  if (through_blended) return opacity > 1e-3 ? texelFetch(blended_depth, at, 0).r / opacity : 0.0;
#endif
  return texelFetch(depth_image, at, 0).r;
}

// How far behind the visible surface the ray is at s, in metres; negative in front of it. Within the pixel of its
// origin the ray counts as in front: there the depth image, one depth per pixel, would hide the ray behind its own
// surface.
float behind_m(ScreenRay ray, float s) {
  vec3 at = ray.from + ray.step * s;
  float seen = depth_under(at.xy);
  float metres = surface_view_depth(view, max(at.z, 1e-30)) - surface_view_depth(view, max(seen, 1e-30));
  bool left = any(notEqual(floor(at.xy), floor(ray.from.xy)));
  return left && seen > 0.0 ? metres : -1.0;
}

// A hit between two places of the ray: in front of the surface at x, behind it at y; x > y: none.
const vec2 kNoHit = vec2(1.0, 0.0);

// Constant step in metres. A surface is met where the ray passes behind it by no more than its thickness or one step.
vec2 march_constant(ScreenRay ray, float depth_m) {
  float count = max(1.0, floor(reflection.k1 * exp(-reflection.k2 * depth_m)));
  float step_depth_m = abs(surface_view_depth(view, max(ray.from.z + ray.step.z, 1e-30)) - depth_m) / count;
  float before = 0.0, at = 0.0, i = 0.0;
  bool met = false;
  do {
    i += 1.0;
    before = at;
    at = place_of(ray, i / count);
    float behind = behind_m(ray, at);
    met = behind > 0.0 && behind < reflection.thickness_m + step_depth_m;
  } while (!met && i < count);
  return met ? vec2(before, at) : kNoHit;
}

// Two levels: tiles of 8×8 pixels in front of whose nearest surface the ray stays are passed in one step, pixels of
// other tiles two at a time. depth_bounds: farthest and nearest depth of each tile.
vec2 march_hierarchical(ScreenRay ray) {
  vec2 pixels = abs(ray.step.xy);
  float fine = 2.0 / max(max(pixels.x, pixels.y), 1e-3);
  vec2 inverse = 1.0 / mix(ray.step.xy, vec2(1e-6), lessThan(pixels, vec2(1e-6)));
  float s = 0.5 * fine, before = 0.0, reached = 0.0;
  uint left = GLOAM_MOST_STEPS;
  bool met = false;
  do {
    vec3 at = ray.from + ray.step * s;
    vec2 tile = floor(at.xy / 8.0);
    vec2 border = (tile + vec2(greaterThan(ray.step.xy, vec2(0.0)))) * 8.0;
    vec2 to_border = mix((border - ray.from.xy) * inverse, vec2(2.0), lessThan(pixels, vec2(1e-6)));
    float leave = max(min(to_border.x, to_border.y), s) + 0.1 * fine;
    float nearest = texelFetch(depth_bounds, ivec2(tile), 0).y;
    bool free = min(at.z, ray.from.z + ray.step.z * leave) > nearest;
    float behind = behind_m(ray, s);
    float slope_m = abs(surface_view_depth(view, max(at.z + ray.step.z * fine, 1e-30)) -
                        surface_view_depth(view, max(at.z, 1e-30)));
    met = !free && behind > 0.0 && behind < reflection.thickness_m + slope_m;
    reached = s;
    float next = free ? leave : s + fine;
    before = met ? before : s;
    s = next;
    --left;
  } while (!met && s < 1.0 && left != 0u);
  return met ? vec2(before, reached) : kNoHit;
}

#endif
