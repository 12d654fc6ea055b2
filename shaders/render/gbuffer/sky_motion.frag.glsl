// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/motion_api.glsl"
#include "shaders/render/view_api.glsl"

// Screen motion of infinitely distant points.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform MotionBlock { MotionConstants motion; };

layout(location = 0) out vec2 out_motion;

void main() {
  out_motion = vec2(0.0);
  if (motion.orthographic != 0u) return;
  vec4 direction = vec4(view_ray(view, gl_FragCoord.xy - 0.5), 0.0);
  // The current position is computed like the previous one and not taken from gl_FragCoord, so that equal cameras give
  // exactly 0.
  out_motion = screen_motion(motion, (view.clip_from_relative * direction).xyw,
                             (motion.previous_clip_from_relative * direction).xyw);
}
