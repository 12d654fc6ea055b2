// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460

// Mean of each square of kDivisor × kDivisor texels. At the border, only texels inside the image count.

layout(constant_id = 0) const int kDivisor = 2;

layout(set = 0, binding = 0) uniform sampler2D lit_image;

layout(location = 0) out vec4 out_light;

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * kDivisor;
  ivec2 count = min(textureSize(lit_image, 0) - first, ivec2(kDivisor));
  vec3 sum = vec3(0.0);
  // Constant bounds: the compiler unrolls the loops.
  for (int y = 0; y < kDivisor; ++y)
    for (int x = 0; x < kDivisor; ++x) {
      vec3 texel = texelFetch(lit_image, first + min(ivec2(x, y), count - 1), 0).rgb;
      if (x < count.x && y < count.y) sum += texel;
    }
  out_light = vec4(sum / float(count.x * count.y), 1.0);
}
