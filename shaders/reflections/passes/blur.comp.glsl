// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/view_shared.h"

// One direction of the Gaussian blur of reflections. Its width follows the dilated spread. Texels that do not reflect
// are left out and the weights are normalised over the rest, so nothing bleeds over silhouettes.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 2) uniform sampler2D dilated_image;
layout(set = 0, binding = 3) uniform sampler2D surface_image;
layout(set = 0, binding = 4) uniform sampler2D color_image;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D blurred_image;

#include "shaders/reflections/passes/blur_lines.glsl"

shared vec4 segment[kSegment];
shared float weights[kSegment];  // 1: the texel reflects
shared uint most;                // greatest reach of the filtered texels

void load(int i) {
  ivec2 texel = segment_texel(i);
  bool reflects = is_inside(texel) && texelFetch(surface_image, texel, 0).y > 0.0;
  weights[i] = reflects ? 1.0 : 0.0;
  segment[i] = reflects ? texelFetch(color_image, texel, 0) : vec4(0.0);
}

void main() {
  int own = int(gl_LocalInvocationIndex);
  if (own == 0) most = 0u;
  barrier();
  load(own);
  load(own + GLOAM_BLUR_GROUP);
  ivec2 texel = segment_texel(own + GLOAM_MOST_BLUR_RADIUS);
  float sigma = 0.0;
  if (is_inside(texel)) {
    float roughness = texelFetch(surface_image, texel, 0).y;
    if (roughness > 0.0) sigma = blur_sigma(texel, texelFetch(dilated_image, texel, 0).x, roughness);
  }
  int reach = sigma > kLeastSigma ? blur_reach(sigma) : 0;
  if (reach > 0) atomicMax(most, uint(reach));
  barrier();
  own += GLOAM_MOST_BLUR_RADIUS;
  vec4 sum = segment[own];
  float total = 1.0, falloff = -0.72134752 / max(sigma * sigma, 1e-6);  // −½ log₂ e / σ²
  int last = int(most);
  for (int k = 1; k <= last; ++k) {
    float weight = k <= reach ? exp2(falloff * float(k * k)) : 0.0;
    float before = weight * weights[own - k], after = weight * weights[own + k];
    sum += before * segment[own - k] + after * segment[own + k];
    total += before + after;
  }
  if (is_inside(texel)) imageStore(blurred_image, texel, weights[own] > 0.0 ? sum / total : vec4(0.0));
}
