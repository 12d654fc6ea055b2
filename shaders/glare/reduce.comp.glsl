// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/glare/glare_shared.h"

// A level of twice the texel's side: weights 1, 3, 3, 1 of eight along each axis, so that each texel of the finer level
// gives the same light and its place is kept. Beyond the margin there is no light, nor in the margin's outer texels.

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Level { GlareLevel c; };
layout(set = 0, binding = 0) uniform sampler2D finer_image;
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D level_image;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, c.size))) return;
  vec2 middle = vec2(2 * (texel - GLOAM_GLARE_MARGIN) + 1 + GLOAM_GLARE_MARGIN);
  vec3 light = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    vec2 at = middle + vec2((i & 1) == 0 ? -0.75 : 0.75, i < 2 ? -0.75 : 0.75);
    light += textureLod(finer_image, at * c.inverse_from, 0.0).rgb;
  }
  imageStore(level_image, texel, vec4(min(0.25 * light, vec3(GLOAM_GLARE_MOST_LIGHT)), 1.0));
}
