// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/view_shared.h"

// One direction of the blur of reflections by the two Gaussians of a lobe, a core and a tail (ReflectionConstants). The
// first direction, along columns, blurs one picture twice; the second blurs each of the two by its own Gaussian and
// adds them up, so that the result is the sum of two round Gaussians. Their width follows the dilated spread. Texels
// that do not reflect are left out and the weights of each are normalised over the rest, so nothing bleeds over
// silhouettes.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 2) uniform sampler2D dilated_image;
layout(set = 0, binding = 3) uniform sampler2D surface_image;
layout(set = 0, binding = 4) uniform sampler2D color_image;  // along rows: the core, and below it the tail
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D blurred_image;  // along columns: the same

#include "shaders/reflections/passes/blur_lines.glsl"

const int kTail = kColumns != 0u ? 0 : 1;  // along columns both Gaussians read the same picture

shared vec4 segment[2][kSegment];
shared float weights[kSegment];  // 1: the texel reflects
shared uint most;                // greatest reach of the filtered texels

void load(int i) {
  ivec2 texel = segment_texel(i);
  bool reflects = is_inside(texel) && texelFetch(surface_image, texel, 0).y > 0.0;
  weights[i] = reflects ? 1.0 : 0.0;
  segment[0][i] = reflects ? texelFetch(color_image, texel, 0) : vec4(0.0);
  if (kColumns == 0u) segment[1][i] = reflects ? texelFetch(color_image, tail_texel(texel), 0) : vec4(0.0);
}

void main() {
  int own = int(gl_LocalInvocationIndex), radius = int(reflection.blur_radius);
  if (own == 0) most = 0u;
  barrier();
  for (int i = 0; i < GLOAM_BLUR_GROUP + 2 * radius; i += GLOAM_BLUR_GROUP) load(own + i);
  own += radius;
  ivec2 texel = segment_texel(own);
  float sigma = 0.0;
  if (is_inside(texel)) {
    float roughness = texelFetch(surface_image, texel, 0).y;
    if (roughness > 0.0) sigma = blur_sigma(texel, texelFetch(dilated_image, texel, 0).x, roughness);
  }
  BlurPart core = blur_part(sigma), tail = blur_part(reflection.blur_tail * sigma);
  int reach = max(core.reach, tail.reach);
  if (reach > 0) atomicMax(most, uint(reach));
  barrier();
  vec4 core_sum = segment[0][own], tail_sum = segment[kTail][own];
  float core_total = 1.0, tail_total = 1.0;
  int last = int(most);
  for (int k = 1; k <= last; ++k) {
    float core_weight = blur_weight(core, k), tail_weight = blur_weight(tail, k);
    float before = weights[own - k], after = weights[own + k];
    core_sum += core_weight * (before * segment[0][own - k] + after * segment[0][own + k]);
    tail_sum += tail_weight * (before * segment[kTail][own - k] + after * segment[kTail][own + k]);
    core_total += core_weight * (before + after);
    tail_total += tail_weight * (before + after);
  }
  if (!is_inside(texel)) return;
  bool reflects = weights[own] > 0.0;
  vec4 in_core = reflects ? core_sum / core_total : vec4(0.0), in_tail = reflects ? tail_sum / tail_total : vec4(0.0);
  if (kColumns != 0u) {
    imageStore(blurred_image, texel, in_core);
    imageStore(blurred_image, tail_texel(texel), in_tail);
  } else {
    imageStore(blurred_image, texel, mix(in_core, in_tail, reflection.blur_tail_share));
  }
}
