// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/occlusion_shared.h"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"

// Occlusion of each pixel from the estimate, which has a texel for 2 × 2 pixels. The mean of 3 × 3 texels holds equal
// shares of the four sets of directions of the estimate. Texels of surfaces off the pixel's plane hardly count.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1) uniform sampler2D depth_image;
layout(set = 0, binding = 2) uniform usampler2D normal_image;
layout(set = 0, binding = 3) uniform sampler2D estimate_image;
layout(push_constant, scalar) uniform Occlusion { OcclusionConstants occlusion; };

layout(location = 0) out float out_hidden;

const float kPlane_m = 0.02;          // distance from the plane at which a texel counts half
const float kPlaneOfDistance = 1e-3;  // and that much more per distance from the camera

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(depth_image, pixel, 0).r;
  out_hidden = 0.0;
  if (depth <= 0.0) return;
  vec3 position = relative_position(view, vec2(pixel), depth);
  vec3 normal = unpack_normal(texelFetch(normal_image, pixel, 0).y);
  float near = kPlane_m * occlusion.metre + kPlaneOfDistance * abs(view_depth(view, position));
  ivec2 last = textureSize(estimate_image, 0) - 1;
  ivec2 middle = pixel / GLOAM_OCCLUSION_SCALE;
  float sum = 0.0, weights = 1e-12;
  for (int i = 0; i < 9; ++i) {
    ivec2 step = ivec2(i % 3, i / 3) - 1;
    ivec2 texel = clamp(middle + step, ivec2(0), last);
    ivec2 there = min(GLOAM_OCCLUSION_SCALE * texel, ivec2(view.size) - 1);
    float there_depth = texelFetch(depth_image, there, 0).r;
    if (there_depth <= 0.0) continue;
    float off = dot(relative_position(view, vec2(there), there_depth) - position, normal) / near;
    // Never 0: a pixel without a texel on its plane takes the nearest.
    float weight = float((2 - abs(step.x)) * (2 - abs(step.y))) / (1.0 + off * off * off * off);
    sum += weight * texelFetch(estimate_image, texel, 0).r;
    weights += weight;
  }
  out_hidden = sum / weights;
}
