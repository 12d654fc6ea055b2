// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef HOST_SHADERS_VEIL_SHARE_GLSL
#define HOST_SHADERS_VEIL_SHARE_GLSL

#include "shaders/render/view_api.glsl"
#include "shaders/veil/veil_shared.h"

layout(push_constant, scalar) uniform Veil { VeilConstants veil; };
layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1) uniform sampler2D depth_image;

// Share of a pixel's light that the mist between the camera and the surface takes: 1 - exp(-density · distance).
float mist_share() {
  float depth = texelFetch(depth_image, ivec2(gl_FragCoord.xy), 0).r;
  if (depth <= 0.0) return veil.density > 0.0 ? 1.0 : 0.0;  // sky: infinitely far
  float distance_m = length(relative_position(view, gl_FragCoord.xy - 0.5, depth));
  return 1.0 - exp(-veil.density * distance_m);
}

#endif
