// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_DEPTH_OF_FIELD_BLUR_LAYER_GLSL
#define GLOAM_SHADERS_DEPTH_OF_FIELD_BLUR_LAYER_GLSL

// Alpha of far texels that are not blurred, besides 0: in focus.
const float kBeside = -1.0;   // in focus, beside pixels before the focus
const float kNothing = -2.0;  // no light
// Below it: kNothing − the greatest circle of the texel's pixels, all before the focus, and their light.

// Whether the light of a far texel can lie behind an object before the focus: that of surfaces behind the focus, in it,
// or with smaller circles. Alphas of the object's texel and the other.
bool lies_behind(float own, float other) {
  return other > kNothing || other - kNothing > 0.8 * (own - kNothing) + 0.25;
}

// Radii of the far layer are stored in sixteenths of a texel: a half float holds them exactly, so texels of one plane
// compare as equal.
float rounded_radius(float radius) { return floor(radius * 16.0 + 0.5) / 16.0; }

// Alpha of near texels: their share in twelfths, and in the fraction the radius of their kernel, which is less than
// 16 texels, in eighths. A half float holds both exactly.
const float kShares = 12.0, kRadii = 16.0;
float rounded_share(float share) { return floor(share * kShares + 0.5) / kShares; }
float packed_near(float share, float radius) {
  return floor(share * kShares + 0.5) + floor(radius * 8.0 + 0.5) / (8.0 * kRadii);
}
float near_share(float packed) { return floor(packed) / kShares; }
float near_radius(float packed) { return fract(packed) * kRadii; }

// Weight of filled light between texels: far less than that of blurred light, which is its kernel in texels.
const float kFilledWeight = 1.0 / 256.0;

#endif
