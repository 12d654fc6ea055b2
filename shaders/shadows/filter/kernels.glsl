// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_FILTER_KERNELS_GLSL
#define GLOAM_SHADERS_SHADOWS_FILTER_KERNELS_GLSL

// Weights of the 8×8 filter: 7×7 cells, each compared bilinearly, which takes 8×8 texels. The weights depend on the
// penumbra's width through a cubic Bézier curve over four kernels, from a point to the widest that the texels allow
// (Thief §1.3.3, after Gruen 2010).
//
// The kernels are a least-squares fit over t = width / 8 texels, 0 ≤ t ≤ 1. Targets: each of the 49 weights is the
// share of a disc (or square) in its cell; and the variance of the disc is the sum of three variances, those of the
// weights, of a cell, and of an edge's position inside a texel of the map (1/12 texel² for each of the latter two). So
// the blur that texels add is not in the penumbra twice. Errors are weighted by how often a width is used (0.25 to 1 by
// the two mips, then below 0.25), errors of the variance 60 times. Kernel 0 is a point, each kernel's sum is 1, and
// weights stay above −0.0035. The standard deviation is within 1.2 % of the disc's for 0.25 ≤ t ≤ 1; bars one texel
// wide give an error of ±0.001 (square: ±0.016) at t = 0.5. The disc of t = 1, 8 texels wide, does not fit into 7
// cells, and the corner weights make up for that; there the coarser mip has all the weight.
//
// A kernel is symmetric about both axes and the diagonals. Of the cells (column, row), counted from the centre, it
// stores a = (0,0) (1,0) (2,0) (3,0), b = (1,1) (2,1) (3,1) (2,2), c = (3,2) (3,3).

struct FilterKernel {
  vec4 a;
  vec4 b;
  vec2 c;
};

// Rows of the kernel, from the middle outwards: weights of the cells 0, 1, 2, 3 columns from the centre.
struct FilterRows {
  vec4 row0;
  vec4 row1;
  vec4 row2;
  vec4 row3;
};

const FilterKernel kDiscKernels[3] =
    FilterKernel[3](FilterKernel(vec4(-0.03808, 0.26899, -0.02201, -0.00013),
                                 vec4(0.07613, -0.01914, -0.00278, -0.00070), vec2(-0.00642, -0.00608)),
                    FilterKernel(vec4(0.01132, -0.01013, 0.10461, -0.01187), vec4(0.10252, 0.04783, -0.01096, -0.01091),
                                 vec2(-0.00183, 0.00287)),
                    FilterKernel(vec4(0.03716, 0.01828, 0.00057, 0.03699), vec4(-0.00477, 0.03327, 0.03044, 0.04372),
                                 vec2(0.00956, -0.00062)));

const FilterKernel kSquareKernels[3] =
    FilterKernel[3](FilterKernel(vec4(-0.17180, 0.25417, -0.01750, -0.00144),
                                 vec4(0.14388, -0.02343, -0.00539, -0.01243), vec2(-0.00687, -0.00235)),
                    FilterKernel(vec4(0.06748, -0.04582, 0.08605, -0.00784), vec4(0.03622, 0.08541, -0.00568, 0.02813),
                                 vec2(-0.00634, -0.01039)),
                    FilterKernel(vec4(0.01376, 0.02660, -0.00107, 0.03152), vec4(-0.00014, 0.00072, 0.03128, 0.03411),
                                 vec2(0.03271, 0.02612)));

// Weights for a penumbra of t · 8 texels, 0 ≤ t ≤ 1. They sum to 1 over the 49 cells. Below two texels the curve is
// left for the point sooner, which is reached at 1.2 texels: there a cell and the map's texels blur as much as the disc
// would, and the curve's weights, right in their variance, would let texels count that lie beside the penumbra.
FilterRows filter_rows(float t, bool square) {
  t = min(t, max(2.5 * t - 0.375, 0.0));
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
