// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_COMMON_MATH_GLSL
#define GLOAM_SHADERS_COMMON_MATH_GLSL

const float kPi = 3.14159265358979323846;

// Cosine and sine of `turns` full turns, with an error of 2e-7. Vulkan lets cos and sin err by 5e-4.
vec2 unit_circle(float turns) {
  precise float quarter = floor(4.0 * turns + 0.5), angle = 2.0 * kPi * (turns - 0.25 * quarter), s = angle * angle;
  precise float cosine = 1.0 + s * (-1.0 / 2.0 + s * (1.0 / 24.0 + s * (-1.0 / 720.0 + s / 40320.0)));
  precise float sine = angle * (1.0 + s * (-1.0 / 6.0 + s * (1.0 / 120.0 + s * (-1.0 / 5040.0 + s / 362880.0))));
  int turned = int(quarter) & 3;
  vec2 v = (turned & 1) == 0 ? vec2(cosine, sine) : vec2(-sine, cosine);
  return turned < 2 ? v : -v;
}

// (1 − exp(−x)) / x for x ≥ 0, which is 1 at 0, with a relative error of a few roundings.
float decay_mean(float x) {
  precise float series = 1.0 + x * (-1.0 / 2.0 + x * (1.0 / 6.0 + x * (-1.0 / 24.0 + x * (1.0 / 120.0 - x / 720.0))));
  return x < 0.125 ? series : (1.0 - exp(-x)) / x;
}

// Octahedral code, in [-1, 1]^2, of a unit vector; the same as in engine/math/packing.h.
vec2 octahedral_encode(vec3 n) {
  n /= abs(n.x) + abs(n.y) + abs(n.z);
  vec2 folded = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
  return n.z >= 0.0 ? n.xy : folded;
}

vec3 octahedral_decode(vec2 code) {
  vec3 n = vec3(code, 1.0 - abs(code.x) - abs(code.y));
  float fold = max(-n.z, 0.0);
  n.xy += vec2(n.x >= 0.0 ? -fold : fold, n.y >= 0.0 ? -fold : fold);
  return normalize(n);
}

uint pack_normal(vec3 n) { return packSnorm2x16(octahedral_encode(n)); }
vec3 unpack_normal(uint packed) { return octahedral_decode(unpackSnorm2x16(packed)); }

// sRGB transfer function of three channels (IEC 61966-2-1); the same as in engine/math/srgb.h. linear_to_srgb clamps
// its argument to [0, 1], srgb_to_linear does not.
vec3 linear_to_srgb(vec3 c) {
  c = clamp(c, vec3(0.0), vec3(1.0));
  return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}

vec3 srgb_to_linear(vec3 c) {
  return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045)));
}

// The derivative of srgb_to_linear at srgb. linear: srgb_to_linear(srgb), in [0, 1].
vec3 srgb_to_linear_slope(vec3 srgb, vec3 linear) {
  return mix(2.4 * linear / (srgb + 0.055), vec3(1.0 / 12.92), lessThanEqual(linear, vec3(0.0031308)));
}

#endif
