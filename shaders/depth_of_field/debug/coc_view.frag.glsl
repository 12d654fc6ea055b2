// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/math.glsl"
#include "shaders/depth_of_field/depth_of_field_shared.h"

// Shows the circle of confusion of each pixel.

layout(constant_id = 0) const uint kEncode = 0u;  // 1: the target needs sRGB from the shader

layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1) uniform sampler2D depth_image;

#include "shaders/depth_of_field/coc_api.glsl"

layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_value;  // radius in pixels, positive behind the focus

void main() {
  float coc = circle_of_confusion(texelFetch(depth_image, ivec2(gl_FragCoord.xy), 0).r);
  float wide = sqrt(clamp(abs(coc) / dof.limit, 0.0, 1.0));
  vec3 color = coc < 0.0 ? vec3(0.9, 0.35 * wide, 0.05) * wide : vec3(0.05, 0.35 * wide, 0.9) * wide;
  if (abs(coc) < kInFocus) color = vec3(0.05, 0.5, 0.1);
  out_color = vec4(kEncode != 0u ? linear_to_srgb(color) : color, 1.0);
  out_value = vec4(coc, 0.0, 0.0, 1.0);
}
