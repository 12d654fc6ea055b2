// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/fog/path.glsl"

// Light that the fog scatters. Means over each square of kDivisor × kDivisor pixels, at the border only over pixels
// inside the image: rgb: of light times its scattered share, alpha: of the light's three channels.

layout(constant_id = 1) const int kDivisor = 2;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Fog { FogConstants fog; };
layout(set = 0, binding = 2) uniform sampler2D depth_image;
layout(set = 0, binding = 3) uniform sampler2D lit_image;

layout(location = 0) out vec4 out_light;

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * kDivisor;
  ivec2 count = min(textureSize(lit_image, 0) - first, ivec2(kDivisor));
  vec4 sum = vec4(0.0);
  // Constant bounds: the compiler unrolls the loops.
  for (int y = 0; y < kDivisor; ++y)
    for (int x = 0; x < kDivisor; ++x) {
      ivec2 at = first + min(ivec2(x, y), count - 1);
      vec3 light = texelFetch(lit_image, at, 0).rgb;
      float share = scattered_share(view, fog, vec2(at) + 0.5, texelFetch(depth_image, at, 0).r);
      if (x < count.x && y < count.y) sum += vec4(light * share, dot(light, vec3(1.0 / 3.0)));
    }
  out_light = sum / float(count.x * count.y);
}
