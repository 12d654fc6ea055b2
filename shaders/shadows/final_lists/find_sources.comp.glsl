// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/common/math.glsl"
#include "shaders/render/view_api.glsl"
#include "shaders/shadows/final_lists/reproject_shared.h"

// For each pixel of the view, the pixel of the frame before that shows the same surface (reproject.glsl). Leaves depth
// and face normal of this frame's pixels for the next one. One thread a pixel.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
// No uniform block: lavapipe 22.3 crashes when it makes constants of the block's conditions.
layout(set = 0, binding = 1, scalar) readonly buffer Reproject { ReprojectBlock reproject; };
layout(set = 0, binding = 2) uniform sampler2D depth_image;
layout(set = 0, binding = 3) uniform usampler2D normal_image;
// Depth as bits and packed face normal of each pixel, tile by tile, row by row. 0 where there is no surface.
layout(set = 0, binding = 4, scalar) readonly buffer LastPixels { uvec2 last_pixels[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer KeptPixels { uvec2 kept_pixels[]; };
// In the same order.
layout(set = 0, binding = 6, scalar) writeonly buffer Sources { uint sources[]; };

uint place_of(uvec2 pixel) {
  uvec2 tile = pixel >> 3, at = pixel & 7u;
  return (tile.y * gl_NumWorkGroups.x + tile.x) << 6 | at.y << 3 | at.x;
}

// Whether the pixel showed, in the frame before, the surface that is now at `position`, relative to that frame's
// camera. pixel_m: width of a pixel there in metres.
bool shows_surface(ivec2 pixel, vec3 position, vec3 normal, float pixel_m) {
  bool inside = all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, ivec2(reproject.last.size)));
  uvec2 there = last_pixels[inside ? place_of(uvec2(pixel)) : 0u];
  float depth = uintBitsToFloat(there.x);
  vec3 was = relative_position(reproject.last, vec2(pixel), max(depth, 1e-30));
  return inside && depth > 0.0 && abs(dot(normal, was - position)) <= pixel_m &&
         dot(normal, unpack_normal(there.y)) >= 0.9;
}

// The pixel of the frame before, x | y << 16, that shows the surface at the camera-relative position `relative`: of the
// four around the place where it was seen, the nearest that does. GLOAM_NO_SOURCE if none does.
uint source_of(vec3 relative, vec3 normal, float pixel_m) {
  vec3 position = relative + reproject.moved;
  vec4 clip = reproject.last.clip_from_relative * vec4(position, 1.0);
  bool seen = clip.w > 0.0;
  vec2 size = vec2(reproject.last.size);
  vec2 at = (clip.xy / (seen ? clip.w : 1.0) * vec2(0.5, -0.5) + 0.5) * size - 0.5;
  seen = seen && all(greaterThan(at, vec2(-0.5))) && all(lessThan(at, size - 0.5));
  if (!seen) return GLOAM_NO_SOURCE;
  ivec2 nearest = ivec2(floor(at + 0.5));
  if (shows_surface(nearest, position, normal, pixel_m)) return uint(nearest.x) | uint(nearest.y) << 16;
  vec2 off = at - vec2(nearest);
  ivec2 aside = ivec2(off.x < 0.0 ? -1 : 1, off.y < 0.0 ? -1 : 1);
  bool across_first = abs(off.x) >= abs(off.y);
  uint found = GLOAM_NO_SOURCE;
  for (int i = 1; i < 4; ++i) {
    bool across = i == 3 || i == (across_first ? 1 : 2), down = i == 3 || i == (across_first ? 2 : 1);
    ivec2 pixel = nearest + ivec2(across ? aside.x : 0, down ? aside.y : 0);
    bool takes = found == GLOAM_NO_SOURCE && shows_surface(pixel, position, normal, pixel_m);
    found = takes ? uint(pixel.x) | uint(pixel.y) << 16 : found;
  }
  return found;
}

// Whether the frame makes the tile anew.
bool is_in_turn(uvec2 tile) {
  // In blocks of 2 x 2 tiles, opposite ones after each other.
  const uint turns[4] = uint[](0u, 2u, 3u, 1u);
  return turns[(tile.y & 1u) << 1 | (tile.x & 1u)] == reproject.phase;
}

void main() {
  uvec2 at = gl_GlobalInvocationID.xy, tile = gl_WorkGroupID.xy;
  ivec2 pixel = ivec2(min(at, view.size - 1u));
  bool inside = all(lessThan(at, view.size));
  float depth = texelFetch(depth_image, pixel, 0).r;
  uint face_normal = texelFetch(normal_image, pixel, 0).y;
  bool surface = inside && depth > 0.0;
  uint place = place_of(at);
  kept_pixels[place] = surface ? uvec2(floatBitsToUint(depth), face_normal) : uvec2(0u);
  uint source = surface ? GLOAM_NO_SOURCE : GLOAM_NO_SURFACE;
  if (surface && reproject.turned_on != 0u && !is_in_turn(tile)) {
    vec3 position = relative_position(view, vec2(at), depth);
    float pixel_m = length(view.ray_dx.xyz) * (view.ray_base.w > 0.0 ? view.ray_base.w / depth : 1.0);
    source = source_of(position, unpack_normal(face_normal), pixel_m);
  }
  sources[place] = source;
}
