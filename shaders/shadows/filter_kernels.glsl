// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_FILTER_KERNELS_GLSL
#define GLOAM_SHADERS_SHADOWS_FILTER_KERNELS_GLSL

// Weights of the 8×8 filter: 7×7 cells, each compared bilinearly, which makes 8×8 texels. They follow the penumbra's width through a cubic
// Bézier over four kernels, from a point to as wide as the texels allow (Thief §1.3.3, after Gruen 2010).
//
// The kernels are a least-squares fit: at t = width / 8 texels, t from 0 to 1, the 49 weights shall be the shares of a disc (or square) of
// that width that lie in each cell, and their second moment, cells included, that of the disc; errors count by how much a width is used
// (0.25 to 1 through the two mips, then below 0.25), those of the moment 60 times. Kernel 0 is held to a point, every kernel's sum to 1,
// weights above −0.003. The standard deviation is within 0.7 % of the disc's for 0.25 ≤ t ≤ 0.9, bars one texel wide leave less than
// ± 0.03 at t = 0.5. The disc of width 8 at t = 1 does not fit into 7 cells; there the coarser mip has all the weight.
//
// A kernel is symmetric to both axes and the diagonals: of cells (column, row), counted from the centre, it needs
// a = (0,0) (1,0) (2,0) (3,0), b = (1,1) (2,1) (3,1) (2,2), c = (3,2) (3,3).

struct FilterKernel {
  vec4 a;
  vec4 b;
  vec2 c;
};

// Rows of the kernel, from the middle out: weights of the cells 0, 1, 2, 3 columns from the centre.
struct FilterRows {
  vec4 row0;
  vec4 row1;
  vec4 row2;
  vec4 row3;
};

const FilterKernel kDiscKernels[3] = FilterKernel[3](
    FilterKernel(vec4(-0.18796, 0.28606, -0.01934, 0.00005), vec4(0.09405, -0.02033, -0.00337, -0.00075), vec2(-0.00533, -0.00502)),
    FilterKernel(vec4(0.11436, -0.04033, 0.10630, -0.01201), vec4(0.08581, 0.05827, -0.01001, -0.01043), vec2(-0.00322, 0.00199)),
    FilterKernel(vec4(-0.00316, 0.03070, 0.00016, 0.03836), vec4(-0.00085, 0.02669, 0.03107, 0.04457), vec2(0.01130, -0.00027)));

const FilterKernel kSquareKernels[3] = FilterKernel[3](
    FilterKernel(vec4(-0.24688, 0.25289, -0.01704, -0.00105), vec4(0.16366, -0.02646, -0.00394, -0.01449), vec2(-0.00484, -0.00177)),
    FilterKernel(vec4(0.11124, -0.05026, 0.09050, -0.00757), vec4(0.01627, 0.08501, -0.00639, 0.04290), vec2(-0.00805, -0.01079)),
    FilterKernel(vec4(-0.00444, 0.02767, -0.00147, 0.03219), vec4(0.00593, 0.00085, 0.03230, 0.02510), vec2(0.03401, 0.02737)));

// Weights of a penumbra that is t · 8 texels wide; t from 0 to 1. Their sum over the 49 cells is 1.
FilterRows filter_rows(float t, bool square) {
  float s = 1.0 - t;
  vec3 bezier = vec3(3.0 * s * s * t, 3.0 * s * t * t, t * t * t);
  FilterKernel k1 = square ? kSquareKernels[0] : kDiscKernels[0];
  FilterKernel k2 = square ? kSquareKernels[1] : kDiscKernels[1];
  FilterKernel k3 = square ? kSquareKernels[2] : kDiscKernels[2];
  vec4 a = k1.a * bezier.x + k2.a * bezier.y + k3.a * bezier.z;
  vec4 b = k1.b * bezier.x + k2.b * bezier.y + k3.b * bezier.z;
  vec2 c = k1.c * bezier.x + k2.c * bezier.y + k3.c * bezier.z;
  a.x += s * s * s;
  return FilterRows(a, vec4(a.y, b.xyz), vec4(a.z, b.y, b.w, c.x), vec4(a.w, b.z, c.x, c.y));
}

#endif
