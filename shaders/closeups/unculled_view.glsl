// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_CLOSEUPS_UNCULLED_VIEW_GLSL
#define GLOAM_SHADERS_CLOSEUPS_UNCULLED_VIEW_GLSL

// For visualizers shadow_unculled and shadow_filtered: the visibility that the map of one close-up pair leaves of its
// light, at every pixel inside the pair's face. Unlike compose.glsl, without the umbra range, the tiles' lists and
// tests of whole tiles. Before including this, define GLOAM_SHADOWS_KINDS: 1 for local lights, 4 for directional ones.

#define GLOAM_SHADOWS_BINDING 6
#define GLOAM_SMOOTH_SURFACE_BINDING 20
#include "shaders/closeups/closeups_shared.h"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"
#include "shaders/shadows/shadows_api.glsl"

layout(constant_id = 1) const uint kEarlier = 0u;  // 1: `earlier` exists

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Closeup { CloseupConstants closeup; };
layout(set = 0, binding = 2) uniform sampler2D depth_image;
layout(set = 0, binding = 3) uniform usampler2D normal_image;
layout(set = 0, binding = 4) uniform sampler2D base_color_image;
layout(set = 0, binding = 5) uniform sampler2D light_texels;
layout(set = 0, binding = 21) uniform sampler2D emissive_image;
layout(set = 0, binding = 22) uniform sampler2D earlier;  // the result of the pairs before this one

#include "shaders/closeups/light_of_pair.glsl"

layout(location = 0) out vec4 out_visibility;

#if GLOAM_SHADOWS_KINDS == 4
vec3 way_to_light(LightOfPair l, vec3 position) { return -closeup.direction; }
#else
vec3 way_to_light(LightOfPair l, vec3 position) { return l.light.position - position; }
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(depth_image, pixel, 0).r;
  vec3 position = relative_position(view, vec2(pixel), max(depth, 1e-30));
  uvec2 normals = texelFetch(normal_image, pixel, 0).xy;
  bool subsurface = texelFetch(base_color_image, pixel, 0).a > 0.5;
  LightOfPair light = light_of_pair();
  float extinction_m = 0.0;
  if (kTransmission != 0u)
    extinction_m = extinction_behind(decode_extinction(texelFetch(emissive_image, pixel, 0).a),
                                     unpack_normal(normals.x), way_to_light(light, position));
  ShadowPoint p = shadow_point(light, pixel_receiver(position, unpack_normal(normals.y), subsurface, pixel));
  bool inside = p.live && depth > 0.0;
  p.live = inside;
  float share = shadow_share(p, extinction_m);
  float visibility = kEarlier != 0u ? texelFetch(earlier, pixel, 0).x : 1.0;
  out_visibility = vec4(inside ? min(visibility, share) : visibility, 0.0, 0.0, 1.0);
}

#endif
