// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_DEPTH_OF_FIELD_BLUR_KERNEL_GLSL
#define GLOAM_SHADERS_DEPTH_OF_FIELD_BLUR_KERNEL_GLSL

#include "shaders/depth_of_field/depth_of_field_shared.h"

// One line of a kernel. Include this after the uniform `dof`.
//
// Round: a Gaussian that fades out, along rows, then along columns. A Gaussian that is cut at the radius of the circle
// of confusion shows its square window when a lamp is far brighter than white. Hexagonal: White and Barré-Brisebois
// 2011, "More Performance! Five Rendering Ideas from Battlefield 3 and Need For Speed: The Run". Three rhombi meet at a
// corner. Each is a line of equal weights along one of three directions, filtered along another: up and right, up and
// left, left and right (both downwards). Here the slanted directions have a slope of 1/2 in place of 0.58. Every odd
// step of a line falls halfway between two texels, which count by half. An even step falls on a texel, which counts by
// half, and its neighbours above and below by a quarter: so all rows get equal light in the rhombus of both slants. The
// lengths of the sides differ by 2 %, the widths of the hexagon by 5 %. A texel counts by the part of it that the line
// covers, so kernels grow evenly.

layout(constant_id = 0) const uint kScale = 2u;  // pixels a texel of the layers
layout(constant_id = 1) const uint kNear = 0u;   // 1: the near layer

// Upright lines are as long as the radius. Slanted lines: texels along x, by the radius.
const float kSlanted = 0.88;

// Shares in a sum of two lines or two rhombi, by their lengths and areas.
const float kUpShare = 1.0 / (1.0 + kSlanted);
const float kRightShare = 1.0 / (2.0 + kSlanted);  // of the rhombus of up and right in the hexagon

// Directions of lines. Rows and columns go both ways. Slanted lines go downwards.
const uint kRow = 0u, kColumn = 1u, kUpward = 2u, kRightward = 3u, kLeftward = 4u;

ivec2 inside(ivec2 texel) { return clamp(texel, ivec2(0), ivec2(dof.layer_size) - 1); }

// Weight of the n-th texel of a line that starts in the middle of texel 0. The small weight keeps the texel itself in
// lines of length 0.
float line_weight(int n, float length) {
  return n == 0 ? clamp(length, 1e-3, 0.5) : clamp(length + 0.5 - float(n), 0.0, 1.0);
}

// Weight at a distance of n texels: exp(−3 t²) · (1 − t²)² with t = n / radius.
float round_weight(int n, float radius) {
  float t = float(n) / max(radius, 1e-3), squared = t * t;
  float fade = max(1.0 - squared, 0.0);
  return exp2(-4.3280851 * squared) * fade * fade;
}

// Sum of weighted texels. A texel of the far layer counts by its circle (alpha), so nothing in focus bleeds into what
// is blurred. The near layer is premultiplied and spreads over everything.
struct LineSum {
  vec4 light;
  float weight;
};
LineSum no_sum() { return LineSum(vec4(0.0), 0.0); }
void add(inout LineSum sum, vec4 texel, float weight) {
  vec4 known = weight > 0.0 ? texel : vec4(0.0);  // a texel without weight may not have been written
  float counted = kNear != 0u ? weight : weight * known.a;
  sum.light += counted * known;
  sum.weight += counted;
}
// Adds an even step of a slanted line: half of a texel, and a quarter of those above and below it.
void add_row_trio(inout LineSum sum, sampler2D image, ivec2 at, float weight) {
  add(sum, texelFetch(image, inside(at), 0), 0.5 * weight);
  add(sum, texelFetch(image, inside(at - ivec2(0, 1)), 0), 0.25 * weight);
  add(sum, texelFetch(image, inside(at + ivec2(0, 1)), 0), 0.25 * weight);
}
// Adds steps n and n + 1 of a slanted line from a texel. n: odd. turn: 1 to the right, −1 to the left.
void add_slanted(inout LineSum sum, sampler2D image, ivec2 texel, int turn, int n, float length) {
  ivec2 between = texel + ivec2(turn * n, n >> 1), next = texel + ivec2(turn * (n + 1), (n + 1) >> 1);
  float weight = 0.5 * line_weight(n, length);
  add(sum, texelFetch(image, inside(between), 0), weight);
  add(sum, texelFetch(image, inside(between + ivec2(0, 1)), 0), weight);
  add_row_trio(sum, image, next, line_weight(n + 1, length));
}
// The mean; alpha of the far layer stays the texel's own.
vec4 mean(LineSum sum, float own_alpha) {
  vec4 light = sum.weight > 0.0 ? sum.light / sum.weight : vec4(0.0);
  return kNear != 0u ? light : vec4(light.rgb, own_alpha);
}

#endif
