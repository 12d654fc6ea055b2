// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/view_shared.h"

// The same as blur.comp in the listed tiles only, without shared memory: for devices that run the threads of a
// workgroup in turn, where a barrier costs more than it saves.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 2) uniform sampler2D dilated_image;
layout(set = 0, binding = 3) uniform sampler2D surface_image;
layout(set = 0, binding = 4) uniform sampler2D color_image;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D blurred_image;

#define GLOAM_MIRROR_TILES 6
#include "shaders/reflections/passes/blur_width.glsl"
#include "shaders/reflections/mirror_surface_api.glsl"

vec4 core_sum = vec4(0.0), tail_sum = vec4(0.0);
float core_total = 0.0, tail_total = 0.0;

void add(ivec2 texel, float core_weight, float tail_weight) {
  bool reflects = is_inside(texel) && texelFetch(surface_image, texel, 0).y > 0.0;
  vec4 color = texelFetch(color_image, texel, 0);
  core_sum += reflects ? core_weight * color : vec4(0.0);
  core_total += reflects ? core_weight : 0.0;
  vec4 of_tail = kColumns != 0u ? color : texelFetch(color_image, tail_texel(texel), 0);
  tail_sum += reflects ? tail_weight * of_tail : vec4(0.0);
  tail_total += reflects ? tail_weight : 0.0;
}

void main() {
  ivec2 texel;
  if (!mirror_texel(texel)) return;
  float roughness = texelFetch(surface_image, texel, 0).y;
  float sigma = roughness > 0.0 ? blur_sigma(texel, texelFetch(dilated_image, texel, 0).x, roughness) : 0.0;
  BlurPart core = blur_part(sigma), tail = blur_part(reflection.blur_tail * sigma);
  add(texel, 1.0, 1.0);
  // Lavapipe runs the body again for threads that have left the loop: beyond a thread's reach its weights are 0.
  int last = max(core.reach, tail.reach);
  for (int k = 1; k <= last; ++k) {
    float core_weight = blur_weight(core, k), tail_weight = blur_weight(tail, k);
    add(texel - k * kAlong, core_weight, tail_weight);
    add(texel + k * kAlong, core_weight, tail_weight);
  }
  vec4 in_core = core_total > 0.0 ? core_sum / core_total : vec4(0.0);
  vec4 in_tail = tail_total > 0.0 ? tail_sum / tail_total : vec4(0.0);
  if (kColumns != 0u) {
    imageStore(blurred_image, texel, in_core);
    imageStore(blurred_image, tail_texel(texel), in_tail);
  } else {
    imageStore(blurred_image, texel, mix(in_core, in_tail, reflection.blur_tail_share));
  }
}
