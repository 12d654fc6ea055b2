// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "shaders/common/math.glsl"
#include "shaders/render/draw_shared.h"
#include "shaders/render/view_shared.h"
#ifdef GLOAM_MOTION
#include "shaders/render/motion_shared.h"
#endif

// Transforms the vertices of a mesh for the fragment shaders that include surface_api.glsl. With GLOAM_MOTION also
// gives the clip positions (x, y, w) of this frame and of the previous one.

layout(location = 0) in vec3 in_position;
layout(location = 1) in uvec2 in_frame;  // octahedral normal; octahedral tangent with the handedness in the lowest bit
layout(location = 2) in vec4 in_uv;
layout(location = 3) in vec4 in_color;
#ifdef GLOAM_MOTION
layout(location = 4) in vec3 in_previous_position;
#endif

// Must match the inputs of surface_api.glsl.
layout(location = 0) out vec4 out_relative_u;
layout(location = 1) out vec4 out_normal_v;
layout(location = 2) out vec4 out_tangent;
layout(location = 3) out vec2 out_uv1;
layout(location = 4) out vec4 out_color;
#ifdef GLOAM_MOTION
layout(location = 5) out vec3 out_clip;
layout(location = 6) out vec3 out_previous_clip;
#endif

// Occluders are drawn by another pipeline before the geometry pass, which must give the same depths.
invariant gl_Position;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
#ifdef GLOAM_MOTION
layout(set = 0, binding = 1, scalar) uniform MotionBlock { MotionConstants motion; };
layout(push_constant, scalar) uniform DrawBlock { MotionDrawConstants motion_draw; };
#define draw motion_draw.draw
#else
layout(push_constant, scalar) uniform DrawBlock { DrawConstants draw; };
#endif

layout(constant_id = 0) const uint kSurface = 0u;

void main() {
  vec3 relative = vec3(dot(draw.row0, vec4(in_position, 1.0)), dot(draw.row1, vec4(in_position, 1.0)),
                       dot(draw.row2, vec4(in_position, 1.0)));
  gl_Position = view.clip_from_relative * vec4(relative, 1.0);
  out_relative_u = vec4(relative, in_uv.x);
#ifdef GLOAM_MOTION
  vec4 before = vec4(in_previous_position, 1.0);
  vec3 previous = vec3(dot(motion_draw.previous_row0, before), dot(motion_draw.previous_row1, before),
                       dot(motion_draw.previous_row2, before));
  out_clip = gl_Position.xyw;
  out_previous_clip = (motion.previous_clip_from_relative * vec4(previous, 1.0)).xyw;
#endif

  // Normals transform with the matrix's cofactors, whose rows are cross products of the matrix's rows. A mirroring
  // matrix flips the cofactors' sign.
  vec3 normal = unpack_normal(in_frame.x);
  vec3 c0 = cross(draw.row1.xyz, draw.row2.xyz);
  vec3 c1 = cross(draw.row2.xyz, draw.row0.xyz);
  vec3 c2 = cross(draw.row0.xyz, draw.row1.xyz);
  vec3 turned = vec3(dot(c0, normal), dot(c1, normal), dot(c2, normal));
  turned = normalize(turned);
  out_normal_v = vec4((draw.flags & GLOAM_DRAW_MIRRORED) != 0u ? -turned : turned, in_uv.y);

  out_tangent = vec4(0.0);
  if ((kSurface & GLOAM_SURFACE_NORMAL_TEXTURE) != 0u) {
    vec3 tangent = unpack_normal(in_frame.y & 0xFFFEFFFFu);
    float handedness = (in_frame.y & 0x10000u) != 0u ? -1.0 : 1.0;
    if ((draw.flags & GLOAM_DRAW_MIRRORED) != 0u) handedness = -handedness;
    tangent = vec3(dot(draw.row0.xyz, tangent), dot(draw.row1.xyz, tangent), dot(draw.row2.xyz, tangent));
    out_tangent = vec4(normalize(tangent), handedness);
  }
  out_uv1 = in_uv.zw;
  out_color = (kSurface & GLOAM_SURFACE_VERTEX_COLOR) != 0u ? in_color : vec4(1.0);
}
