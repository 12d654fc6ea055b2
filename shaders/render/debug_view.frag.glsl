// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/math.glsl"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"

// Shows one channel of the geometry buffer. view.visualizer: 1 albedo, 2 normal, 3 depth.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1) uniform sampler2D base_color_image;
layout(set = 0, binding = 2) uniform usampler2D normal_image;
layout(set = 0, binding = 3) uniform sampler2D depth_image;

layout(constant_id = 0) const uint kEncode = 0u;  // 1: the target does not encode sRGB by itself

layout(location = 0) out vec4 out_color;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(depth_image, pixel, 0).r;
  vec3 shown = vec3(0.0);
  if (depth > 0.0) {
    if (view.visualizer == 1u) shown = pow(texelFetch(base_color_image, pixel, 0).rgb, vec3(2.0));
    if (view.visualizer == 2u) {
      // Decoded, so that the sRGB-encoded picture holds -1 as 0, 0 as 128 and 1 as 255.
      shown = srgb_to_linear(unpack_normal(texelFetch(normal_image, pixel, 0).x) * 0.5 + 0.5);
    }
    if (view.visualizer == 3u) {
      float metres = view_depth(view, relative_position(view, gl_FragCoord.xy - 0.5, depth));
      shown = vec3(1.0 / (1.0 + 0.1 * metres));
    }
  }
  out_color = vec4(kEncode != 0u ? linear_to_srgb(shown) : shown, 1.0);
}
