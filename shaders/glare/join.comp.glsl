// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/glare/glare_shared.h"

// Adds up the four parts of each cell's light that collect.comp has written: the finest level, with its margin.

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Level { GlareLevel c; };
layout(set = 0, binding = 0) uniform sampler2D parts_image;
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D level_image;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, c.size))) return;
  // The parts of the cell before the picture's first one are the texels 0 and -1 of an axis, of which only one exists.
  ivec2 first = 2 * (texel - GLOAM_GLARE_MARGIN) + 1, most = textureSize(parts_image, 0) - 1;
  vec3 light = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 part = first + ivec2(i & 1, i >> 1), inside = clamp(part, ivec2(0), most);
    light += part == inside ? texelFetch(parts_image, inside, 0).rgb : vec3(0.0);
  }
  imageStore(level_image, texel, vec4(min(light, vec3(GLOAM_GLARE_MOST_LIGHT)), 1.0));
}
