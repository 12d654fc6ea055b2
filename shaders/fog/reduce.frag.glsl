// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460

// Mean of each square of kDivisor² texels; squares that hang over the border count only texels that exist.

layout(constant_id = 0) const int kDivisor = 2;

layout(set = 0, binding = 0) uniform sampler2D lit_image;

layout(location = 0) out vec4 out_light;

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * kDivisor;
  ivec2 last = min(first + kDivisor, textureSize(lit_image, 0));
  vec3 sum = vec3(0.0);
  for (int y = first.y; y < last.y; ++y)
    for (int x = first.x; x < last.x; ++x) sum += texelFetch(lit_image, ivec2(x, y), 0).rgb;
  ivec2 count = last - first;
  out_light = vec4(sum / float(count.x * count.y), 1.0);
}
