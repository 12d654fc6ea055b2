// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define GLOAM_SHADOWS_BINDING 6
#include "shaders/common/math.glsl"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/view_api.glsl"
#include "shaders/shadows/shadows_api.glsl"

// Positions at which the contact-hardening filter of one local light gathers for each pixel, without early-outs: the
// first corner of the blocker search and of both mips of the filter, in texels of the atlas image. -1 where the light
// does not reach.

layout(push_constant, scalar) uniform Push { uint shown; };
layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Lights { LightBlock lights; };
layout(set = 0, binding = 2) uniform sampler2D depth_image;
layout(set = 0, binding = 3) uniform usampler2D normal_image;
layout(set = 0, binding = 4) uniform sampler2D base_color_image;
layout(set = 0, binding = 5) uniform sampler2D light_texels;

layout(location = 0) out vec4 out_search_and_fine;
layout(location = 1) out vec4 out_coarse;

vec2 first_corner(ShadowPoint p, int mip) {
  Kernel k = make_kernel(p, mip, 8);
  return k.square.corner + clamp(k.base + 1.0, vec2(1.0), vec2(max(k.square.size - 7.0, 1.0)));
}

void main() {
  float depth = texelFetch(depth_image, ivec2(gl_FragCoord.xy), 0).r;
  out_search_and_fine = vec4(-1.0);
  out_coarse = vec4(-1.0);
  if (depth <= 0.0) return;
  ShadowReceiver r = drawn_receiver(relative_position(view, gl_FragCoord.xy - 0.5, depth),
                                    unpack_normal(texelFetch(normal_image, ivec2(gl_FragCoord.xy), 0).y),
                                    texelFetch(base_color_image, ivec2(gl_FragCoord.xy), 0).a > 0.5);
  LocalLight light = fetch_light(light_texels, shown);
  vec3 to_light;
  if (!(local_illuminance(light, r.position, to_light).x > 0.0)) return;
  ShadowPoint p = local_shadow_point(shown, light.position, r);
  if (!p.live) return;
  SearchRegion region = find_region(p);
  int last = coarsest_mip(p, 8);
  int mip = region_mip(p, region);
  float width = penumbra_width(p, region_blockers(p, region).depth);
  int fine = min(floor_log2(max(0.25 * width, 1.0)), last);
  out_search_and_fine = vec4(first_corner(p, mip), first_corner(p, fine));
  out_coarse = vec4(first_corner(p, min(fine + 1, last)), 0.0, 0.0);
}
