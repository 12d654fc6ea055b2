// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT

// Draws the blades of one class into the geometry buffer. With GLOAM_MOTION also their motion.

#include "shaders/render/view_api.glsl"

layout(constant_id = 0) const uint kClass = 0u;
layout(constant_id = 1) const uint kSegments = 15u;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };

#include "shaders/grass/drawing/blade_shape.glsl"
#include "shaders/grass/drawing/pixel_width.glsl"

layout(location = 0) out vec3 out_normal;
layout(location = 1) out vec3 out_binormal;
layout(location = 2) out vec3 out_place;  // along, across, layer
layout(location = 3) out vec3 out_relative;
layout(location = 6) out vec2 out_coverage;  // PixelCorner::coverage; threshold of the blade
#ifdef GLOAM_MOTION
#include "shaders/grass/way_api.glsl"
#include "shaders/render/motion_api.glsl"
layout(set = 0, binding = 4, scalar) uniform MotionBlock { MotionConstants motion; };
layout(set = 0, binding = 5, scalar) readonly buffer PreviousKnots { vec4 previous_knots[]; };  // a step earlier
layout(set = 0, binding = 6, scalar) uniform Steps { GrassSteps steps; };
layout(set = 0, binding = 7, scalar) readonly buffer Stamps { uint stamps[]; };  // step that each master has reached
layout(location = 4) out vec3 out_clip;
layout(location = 5) out vec3 out_previous_clip;
#endif

void main() {
  uint blade = blade_of_vertex(gl_InstanceIndex, gl_VertexIndex, kSegments), count = draws.class_count[kClass];
  BladeVertex v =
      blade_vertex(draws.class_first[kClass] + min(blade, max(count, 1u) - 1u), gl_VertexIndex, kSegments, 1.0);
  vec4 clip = blade < count ? view.clip_from_relative * vec4(v.relative, 1.0) : vec4(2.0, 2.0, 0.0, 1.0);
  PixelCorner corner = pixel_corner(view.clip_from_relative * vec4(v.middle, 1.0), clip,
                                    view.clip_from_relative * vec4(v.ahead, 1.0), vec2(view.size));
  gl_Position = blade < count ? corner.position : clip;
  out_coverage = vec2(corner.coverage, v.threshold);
  out_normal = v.normal;
  out_binormal = v.binormal;
  out_place = vec3(v.along, v.across, float(v.layer));
  out_relative = v.relative;
#ifdef GLOAM_MOTION
  out_clip = clip.xyw;
  // A slave's pose in the frame before is taken to be that of this frame.
  bool moves = steps.moves != 0u && steps.now - stamps[v.knot / uint(GLOAM_GRASS_KNOTS)] < steps.frame_steps;
  vec3 way = posed(poses[v.pose], unpack_way(vec2(knots[v.knot].w, previous_knots[v.knot].w)));
  vec3 before = v.relative - poses[v.pose].carried * draws.units_per_metre;
  out_previous_clip = previous_clip_at_rest(motion, moves ? before - way * draws.units_per_metre : before);
#endif
}
