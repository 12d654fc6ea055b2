// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_MOTION_API_GLSL
#define GLOAM_SHADERS_RENDER_MOTION_API_GLSL

// Screen motion, as GeometryOutputs::motion defines it. Vertex shaders pass the clip positions (x, y, w) of this frame
// and of the previous one, interpolated in perspective.

#include "shaders/render/motion_shared.h"

const float kFarthestMotion = 65536.0;  // pixels; outside of any picture

// Clip position (x, y, w) in the previous frame of a point that does not move. relative: its camera-relative position
// in this frame.
vec3 previous_clip_at_rest(MotionConstants motion, vec3 relative) {
  return (motion.previous_clip_from_relative * vec4(relative + motion.moved, 1.0)).xyw;
}

// Motion in pixels, x to the right, y down. clip, previous_clip: x, y, w.
vec2 screen_motion(MotionConstants motion, vec3 clip, vec3 previous_clip) {
  if (!(previous_clip.z > 0.0)) return vec2(kFarthestMotion);  // was behind the previous camera
  vec2 moved = (clip.xy / clip.z - previous_clip.xy / previous_clip.z) * motion.half_size;
  return clamp(moved, vec2(-kFarthestMotion), vec2(kFarthestMotion));
}

#endif
