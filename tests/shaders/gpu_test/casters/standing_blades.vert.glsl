// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/motion_api.glsl"
#include "shaders/render/view_shared.h"

// Blades without vertex streams, for the tests of PassPhase::geometry: three triangles a blade, in the plane of x and
// y, counter-clockwise seen from +z. tests/render/passes/geometry_phase_gpu_test.cpp has the same corners.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform MotionBlock { MotionConstants motion; };
layout(set = 0, binding = 2, scalar) readonly buffer Blades { vec4 blades[]; };  // camera-relative root, height

layout(location = 0) out vec3 out_clip;
layout(location = 1) out vec3 out_previous_clip;

const vec2 kCorners[9] = vec2[](vec2(-1.0, 0.0), vec2(1.0, 0.0), vec2(1.0, 0.5), vec2(-1.0, 0.0), vec2(1.0, 0.5),
                                vec2(-1.0, 0.5), vec2(-1.0, 0.5), vec2(1.0, 0.5), vec2(0.0, 1.0));

void main() {
  vec4 blade = blades[gl_InstanceIndex];
  vec2 corner = kCorners[gl_VertexIndex] * vec2(0.25, 1.0) * blade.w;
  vec3 relative = blade.xyz + vec3(corner, 0.0);
  gl_Position = view.clip_from_relative * vec4(relative, 1.0);
  out_clip = gl_Position.xyw;
  out_previous_clip = previous_clip_at_rest(motion, relative);
}
