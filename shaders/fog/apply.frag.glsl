// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/fog/path.glsl"

// Homogeneous fog. Where it scatters the share S = 1 - exp(-density · d) of the light of a pixel at distance d, it
// changes that light to
//   (1 - S) · light + S · radiance + forward · glow
// where glow is the light that other pixels lose by small angles: light that is scattered before it is as near as this
// pixel's surface does not reach the pixel. Of a neighbour with the share S', that is min(S, S') of its light. The
// blurred image holds only the mean of S' · light and of light (reduce.frag.glsl); where this pixel is nearer than the
// light that glows, its glow is in proportion to S over the mean of S'. Blending computes the first term
// (premultiplied: alpha = S). The scattered light is at most S · 65504, like all light of the target: more would
// overflow to infinity.

layout(constant_id = 1) const int kDivisor = 1;  // size of the picture over the glow's

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Fog { FogConstants fog; };
layout(set = 0, binding = 2) uniform sampler2D depth_image;
layout(set = 0, binding = 3) uniform sampler2D glow_image;

layout(location = 0) out vec4 out_light;

const float kRounding = 1.0 + 1.0 / 256.0;  // of the glow, where all surfaces are as far

void main() {
  float scattered = scattered_share(view, fog, gl_FragCoord.xy, texelFetch(depth_image, ivec2(gl_FragCoord.xy), 0).r);
  // A texel of the glow covers kDivisor × kDivisor pixels, also where the picture ends inside it.
  vec2 covered = vec2(view.size) / vec2(textureSize(glow_image, 0) * kDivisor);
  vec4 glow = textureLod(glow_image, gl_FragCoord.xy * view.inverse_size * covered, 0.0);
  float lost = dot(glow.rgb, vec3(1.0 / 3.0)), nearer = min(scattered * glow.a * kRounding, lost) / max(lost, 1e-30);
  vec3 light = scattered * fog.radiance.rgb + fog.forward * nearer * glow.rgb;
  out_light = vec4(min(light, vec3(scattered * 65504.0)), scattered);
}
