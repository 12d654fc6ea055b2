// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460

// Enlarges a picture along one axis by a Lanczos-2 filter; two passes enlarge both. The kernel is the polynomial of AMD
// FidelityFX Super Resolution 1.0 (ffx_fsr1.h, FsrEasuTapF, lob = 1/4) in place of sines. The result is kept between
// the two nearest texels, so that edges stay sharp without ringing. Works on sRGB-encoded values, as FSR does: in
// linear light the clamp would let bright sides of edges grow.

layout(constant_id = 0) const uint kVertical = 0u;

layout(set = 0, binding = 0) uniform sampler2D picture;

layout(push_constant) uniform Push { float texels_per_pixel; };

layout(location = 0) out vec4 out_color;

float kernel(float x) {
  float x2 = min(x * x, 4.0);
  float a = 0.4 * x2 - 1.0;
  float b = 0.25 * x2 - 1.0;
  return (25.0 / 16.0 * a * a - 9.0 / 16.0) * (b * b);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  bool vertical = kVertical != 0u;
  float along = (vertical ? gl_FragCoord.y : gl_FragCoord.x) * texels_per_pixel - 0.5;
  int first = int(floor(along));
  float part = along - float(first);
  ivec2 size = textureSize(picture, 0);
  int last = (vertical ? size.y : size.x) - 1;
  vec3 texels[4];
  for (int i = 0; i < 4; ++i) {
    int at = clamp(first - 1 + i, 0, last);
    texels[i] = texelFetch(picture, vertical ? ivec2(pixel.x, at) : ivec2(at, pixel.y), 0).rgb;
  }
  vec4 weights = vec4(kernel(1.0 + part), kernel(part), kernel(1.0 - part), kernel(2.0 - part));
  weights /= weights.x + weights.y + weights.z + weights.w;
  vec3 sum = weights.x * texels[0] + weights.y * texels[1] + weights.z * texels[2] + weights.w * texels[3];
  out_color = vec4(clamp(sum, min(texels[1], texels[2]), max(texels[1], texels[2])), 1.0);
}
