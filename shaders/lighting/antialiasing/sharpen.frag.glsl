// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/antialiasing/temporal_state.glsl"
#include "shaders/lighting/lighting_shared.h"
#include "shaders/lighting/target.glsl"

// Writes the accumulated light to the picture. Where the picture moves, looking up the history between its texels has
// blurred it: there the difference from the neighbours is enlarged, up to their least and greatest light. Pixels
// without a history are left as they are.

layout(constant_id = 0) const uint kDither = 0u;

layout(push_constant, scalar) uniform Sharpen { AntialiasingConstants c; };
layout(set = 0, binding = 0) uniform sampler2D accumulated_image;  // alpha: packed PixelState
layout(set = 0, binding = 1) uniform sampler2D kept_motion;

layout(location = 0) out vec4 out_color;

const float kSharpening = 0.25;  // of the difference, at a quarter of a pixel of motion and above

vec3 accumulated(ivec2 pixel) {
  return texelFetch(accumulated_image, clamp(pixel, ivec2(0), ivec2(c.size) - 1), 0).rgb;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 motion = abs(texelFetch(kept_motion, pixel, 0).xy);
  float strength = kSharpening * clamp(4.0 * max(motion.x, motion.y) - 0.08, 0.0, 1.0);
  if (unpack_state(texelFetch(accumulated_image, pixel, 0).a).frames < 2.0) strength = 0.0;
  vec3 own = accumulated(pixel);
  vec3 left = accumulated(pixel - ivec2(1, 0)), right = accumulated(pixel + ivec2(1, 0));
  vec3 above = accumulated(pixel - ivec2(0, 1)), below = accumulated(pixel + ivec2(0, 1));
  vec3 low = min(min(own, min(left, right)), min(above, below));
  vec3 high = max(max(own, max(left, right)), max(above, below));
  vec3 color = clamp(own + strength * (own - 0.25 * (left + right + above + below)), low, high);
  out_color = vec4(value_for_target(color, uvec2(pixel), c.encode_srgb != 0u, kDither != 0u), 1.0);
}
