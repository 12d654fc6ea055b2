// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/reflections/hit_distance_api.glsl"
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/motion_api.glsl"
#include "shaders/render/view_shared.h"

// Accumulates reflections over frames. A reflection is looked up where its mirror image was in the previous frame: the
// point as far behind the mirror as the hit is in front of it. What was there is limited to the range of colours around
// the texel now, so that nothing lags behind that has moved or was hidden.

layout(local_size_x = GLOAM_REFLECTION_GROUP, local_size_y = GLOAM_REFLECTION_GROUP) in;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 2, scalar) uniform MotionBlock { MotionConstants motion; };
layout(set = 0, binding = 3) uniform usampler2D mirror_image;
layout(set = 0, binding = 4) uniform sampler2D surface_image;
layout(set = 0, binding = 5) uniform sampler2D color_image;
layout(set = 0, binding = 6) uniform sampler2D previous_image;
layout(set = 0, binding = 7, rgba16f) uniform writeonly image2D accumulated_image;

layout(push_constant, scalar) uniform Push { float share; };  // of the new frame; 1: there is no previous one

#include "shaders/reflections/mirror_surface_api.glsl"

// Range of the colours of the reflecting texels around a texel.
void color_range(ivec2 texel, out vec4 low, out vec4 high) {
  low = vec4(65504.0);
  high = vec4(0.0);
  for (int i = 0; i < 9; ++i) {
    ivec2 at = clamp(texel + ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), ivec2(reflection.size) - 1);
    bool reflects = texelFetch(surface_image, at, 0).y > 0.0;
    vec4 color = texelFetch(color_image, at, 0);
    low = reflects ? min(low, color) : low;
    high = reflects ? max(high, color) : high;
  }
}

// Where the mirror image was on the previous screen, 0…1 inside; outside: nowhere.
vec2 previous_place(MirrorSurface s, float distance_m) {
  vec3 seen = vec3(s.direction.x, -s.direction.y, s.direction.z);
  vec3 clip = previous_clip_at_rest(motion, s.position + seen * distance_m);
  return clip.z > 0.0 ? 0.5 + clip.xy / clip.z * vec2(0.5, -0.5) : vec2(-1.0);
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(uvec2(texel), reflection.size))) return;
  MirrorSurface s = decode_mirror_surface(texelFetch(mirror_image, texel, 0).xy, texel);
  vec4 color = vec4(0.0);
  if (s.share > 0.0) {
    color = texelFetch(color_image, texel, 0);
    vec2 place = previous_place(s, reflection.unit_m * unpack_hit_distance(texelFetch(surface_image, texel, 0).zw));
    bool known = share < 1.0 && all(greaterThan(place, vec2(0.0))) && all(lessThan(place, vec2(1.0)));
    // Each texel of the previous image shows the first pixel of its block.
    vec2 scaled = ((place * vec2(view.size) - 0.5) / float(reflection.scale) + 0.5) / vec2(reflection.size);
    vec4 low, high, before = textureLod(previous_image, scaled, 0.0);
    color_range(texel, low, high);
    color = known ? mix(clamp(before, low, high), color, share) : color;
  }
  imageStore(accumulated_image, texel, color);
}
