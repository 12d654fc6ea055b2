// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "shaders/render/gbuffer_api.glsl"
#ifdef GLOAM_MOTION
#include "shaders/render/motion_api.glsl"
#endif

// A green surface that faces +z, for the tests of PassPhase::geometry. With GLOAM_MOTION also its motion.

layout(location = 0) out vec4 out_base_color;
layout(location = 1) out uvec4 out_normals;
layout(location = 2) out vec4 out_material;
layout(location = 3) out vec4 out_emissive;

#ifdef GLOAM_MOTION
layout(location = 0) in vec3 in_clip;
layout(location = 1) in vec3 in_previous_clip;
layout(set = 0, binding = 1, scalar) uniform MotionBlock { MotionConstants motion; };
layout(location = 4) out vec2 out_motion;
#endif

void main() {
  const vec3 normal = vec3(0.0, 0.0, 1.0);
  out_base_color = encode_base_color(vec3(0.25, 0.5, 0.125), false);
  out_normals = encode_normals(normal, normal);
  out_material = vec4(0.75, 0.0, 1.0, 0.25);
  out_emissive = vec4(0.0);
#ifdef GLOAM_MOTION
  out_motion = screen_motion(motion, in_clip, in_previous_clip);
#endif
}
