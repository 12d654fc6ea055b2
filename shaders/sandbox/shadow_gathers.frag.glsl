// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460

// Lower bound for the time of a contact-hardening filter: only its 48 gathers per pixel, at the positions that
// shadow_footprints.frag wrote.

layout(set = 0, binding = 0) uniform sampler2D search_and_fine_image;
layout(set = 0, binding = 1) uniform sampler2D coarse_image;
layout(set = 0, binding = 2) uniform sampler2D atlas;

layout(location = 0) out float out_sum;

vec4 gathers(vec2 first, vec2 texel) {
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 16; ++i) sum += textureGather(atlas, (first + vec2(2 * (i & 3), 2 * (i >> 2))) * texel);
  return sum;
}

void main() {
  vec2 texel = 1.0 / vec2(textureSize(atlas, 0));
  vec4 search_and_fine = texelFetch(search_and_fine_image, ivec2(gl_FragCoord.xy), 0);
  vec2 coarse = texelFetch(coarse_image, ivec2(gl_FragCoord.xy), 0).xy;
  vec4 sum = vec4(0.0);
  // A loop instead of an if: software devices run the body of an if even where its condition is false.
  if (coarse.x >= 0.0) do {
      sum = gathers(search_and_fine.xy, texel) + gathers(search_and_fine.zw, texel) + gathers(coarse, texel);
    } while (coarse.y < 0.0);
  out_sum = dot(sum, vec4(1.0));
}
