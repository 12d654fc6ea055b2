// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/fog/fog_shared.h"
#include "shaders/render/view_api.glsl"

// Homogeneous fog. It changes the light of a pixel at distance d, with transmittance T = exp(-density · d), to
//   T · light + (1 - T) · (radiance + forward · glow)
// where glow is the blurred picture: light scattered by small angles. Blending computes the first term (premultiplied:
// alpha = 1 - T).

layout(constant_id = 0) const uint kOrthographic = 0u;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Fog { FogConstants fog; };
layout(set = 0, binding = 2) uniform sampler2D depth_image;
layout(set = 0, binding = 3) uniform sampler2D glow_image;

layout(location = 0) out vec4 out_light;

void main() {
  float depth = texelFetch(depth_image, ivec2(gl_FragCoord.xy), 0).r;
  float distance_m = kOrthographic != 0u
                         ? view_depth(view, relative_position(view, gl_FragCoord.xy - 0.5, max(depth, 1e-9)))
                         : perspective_distance(view, gl_FragCoord.xy - 0.5, max(depth, 1e-9));
  if (depth <= 0.0) distance_m = fog.sky_distance_m;
  float scattered = 1.0 - exp(-fog.density * min(distance_m, fog.sky_distance_m));
  vec3 glow = textureLod(glow_image, gl_FragCoord.xy * view.inverse_size, 0.0).rgb;
  out_light = vec4(scattered * (fog.radiance.rgb + fog.forward * glow), scattered);
}
