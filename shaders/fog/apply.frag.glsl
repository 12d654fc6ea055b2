// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/fog/fog_shared.h"
#include "shaders/render/view_api.glsl"

// Homogeneous fog. It changes the light of a pixel at distance d, with transmittance T = exp(-density · d), to
//   T · light + (1 - T) · (radiance + forward · glow)
// where glow is the blurred picture: light scattered by small angles. Blending computes the first term (premultiplied:
// alpha = 1 - T). The scattered light is at most 65504, like all light of the target: more would overflow to infinity.

layout(constant_id = 0) const uint kOrthographic = 0u;
layout(constant_id = 1) const int kDivisor = 1;  // size of the picture over the glow's

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Fog { FogConstants fog; };
layout(set = 0, binding = 2) uniform sampler2D depth_image;
layout(set = 0, binding = 3) uniform sampler2D glow_image;

layout(location = 0) out vec4 out_light;

void main() {
  float depth = texelFetch(depth_image, ivec2(gl_FragCoord.xy), 0).r;
  // The bound keeps the distance of a sky pixel, which is not used, free of 0 / 0. Depths below it are farther than the
  // sky's distance with any near plane.
  float distance_m = kOrthographic != 0u ? view_depth(view, relative_position(view, gl_FragCoord.xy - 0.5, depth))
                                         : perspective_distance(view, gl_FragCoord.xy - 0.5, max(depth, 1e-30));
  if (depth <= 0.0) distance_m = fog.sky_distance_m;
  float scattered = 1.0 - exp(-fog.density * min(distance_m, fog.sky_distance_m));
  // A texel of the glow covers kDivisor × kDivisor pixels, also where the picture ends inside it.
  vec2 covered = vec2(view.size) / vec2(textureSize(glow_image, 0) * kDivisor);
  vec3 glow = textureLod(glow_image, gl_FragCoord.xy * view.inverse_size * covered, 0.0).rgb;
  out_light = vec4(scattered * min(fog.radiance.rgb + fog.forward * glow, vec3(65504.0)), scattered);
}
