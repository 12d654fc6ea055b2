// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/reflections/hit_distance_api.glsl"
#include "shaders/reflections/passes/planar_shared.h"
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/view_shared.h"

// Planar reflections, in place of screen space and proxies: surfaces at the mirror plane take the mirrored picture. A
// point of the plane is at the same place in the picture of the view and in the mirrored one.

layout(constant_id = 0) const uint kPixelRoughness = 1u;  // 0: one spread for all surfaces, as in the paper

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 2) uniform usampler2D mirror_image;
layout(set = 0, binding = 5) uniform sampler2D mirrored_light;
layout(set = 0, binding = 6) uniform sampler2D mirrored_depth;
layout(set = 0, binding = 7, rgba16f) uniform writeonly image2D color_image;  // premultiplied radiance, confidence
layout(set = 0, binding = 8, rgba8) uniform writeonly image2D surface_image;  // spread, roughness, packed distance

layout(push_constant, scalar) uniform Push { PlanarConstants planar; };

#define GLOAM_MIRROR_TILES 3
#include "shaders/reflections/spread_api.glsl"

// Radiance without NaN, infinity and negative values.
vec3 clean(vec3 light) {
  return vec3(light.r > 0.0 ? min(light.r, 65504.0) : 0.0, light.g > 0.0 ? min(light.g, 65504.0) : 0.0,
              light.b > 0.0 ? min(light.b, 65504.0) : 0.0);
}

// Bilinear at a place in the picture, 0…1. The centres of both images' texels coincide unless the view has an odd size.
vec3 light_at(vec2 uv) {
  vec2 size = vec2(textureSize(mirrored_light, 0)), at = clamp(uv * size - 0.5, vec2(0.0), size - 1.0);
  vec2 part = fract(at);
  part = mix(part, round(part), lessThan(abs(part - round(part)), vec2(1e-3)));
  ivec2 base = ivec2(at), last = ivec2(size) - 1;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 offset = ivec2(i & 1, i >> 1);
    vec2 weights = mix(1.0 - part, part, vec2(offset));
    float weight = weights.x * weights.y;
    if (weight > 0.0) sum += weight * clean(texelFetch(mirrored_light, min(base + offset, last), 0).rgb);
  }
  return sum;
}

// Along the mirrored ray, from the surface to what the mirrored picture shows there.
float distance_at(vec2 uv, MirrorSurface s) {
  ivec2 size = textureSize(mirrored_depth, 0);
  float depth = texelFetch(mirrored_depth, clamp(ivec2(uv * vec2(size)), ivec2(0), size - 1), 0).r;
  float surface_m = view_depth(view, s.position), behind_m = surface_view_depth(view, max(depth, 1e-30)) - surface_m;
  float per_depth = view.orthographic != 0u ? 1.0 : length(s.position) / max(surface_m, view.near_m);
  return depth > 0.0 ? max(behind_m, 0.0) * per_depth : kMostHitCentimetres * 0.01 * reflection.unit_m;
}

void main() {
  ivec2 texel;
  if (!mirror_texel(texel)) return;
  MirrorSurface s = decode_mirror_surface(texelFetch(mirror_image, texel, 0).xy, texel);
  vec4 color = vec4(0.0), surface = vec4(0.0);
  if (s.share > 0.0 && abs(s.position.y - planar.height_m) <= planar.slack_m) {
    vec2 uv = (vec2(texel) + 0.5) * float(reflection.scale) * view.inverse_size;
    float distance_m = distance_at(uv, s);
    color = vec4(light_at(uv), 1.0) * s.share;
    float spread = kPixelRoughness != 0u ? mirrored_share(s, distance_m) : screen_distance(s, distance_m);
    surface = vec4(spread, max(s.roughness, 1.0 / 255.0), pack_hit_distance(distance_m / reflection.unit_m));
  }
  imageStore(color_image, texel, color);
  imageStore(surface_image, texel, surface);
}
