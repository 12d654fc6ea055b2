// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/glare/glare_shared.h"

// The spread light of a level and of all coarser ones: the level blurred by 1, 2, 1 of four along each axis, times its
// share (kOwn = 1), and the coarser level's spread light between its texels (kCoarser = 1).

layout(constant_id = 0) const uint kOwn = 1u;
layout(constant_id = 1) const uint kCoarser = 1u;

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Level { GlareLevel c; };
layout(set = 0, binding = 0) uniform sampler2D level_image;
layout(set = 0, binding = 1) uniform sampler2D coarser_image;
layout(set = 0, binding = 2, rgba16f) uniform writeonly image2D spread_image;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, c.size))) return;
  vec3 light = vec3(0.0);
  if (kOwn != 0u) {
    vec2 inverse = 1.0 / vec2(c.size);
    for (int i = 0; i < 4; ++i) light += textureLod(level_image, vec2(texel + ivec2(i & 1, i >> 1)) * inverse, 0.0).rgb;
    light *= 0.25 * c.weight;
  }
  if (kCoarser != 0u) {
    vec2 at = (vec2(texel - GLOAM_GLARE_MARGIN) + 0.5) * 0.5 + float(GLOAM_GLARE_MARGIN);
    light += textureLod(coarser_image, at * c.inverse_from, 0.0).rgb;
  }
  imageStore(spread_image, texel, vec4(min(light, vec3(GLOAM_GLARE_MOST_LIGHT)), 1.0));
}
