// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/surface_api.glsl"
#include "shaders/render/view_api.glsl"
#ifdef GLOAM_MOTION
#include "shaders/render/motion_api.glsl"
#endif

// Writes the surface of a fragment to the geometry buffer (layout in gbuffer_api.glsl), with GLOAM_MOTION also its
// motion.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };

layout(location = 0) out vec4 out_base_color;
layout(location = 1) out uvec4 out_normals;
layout(location = 2) out vec4 out_material;
layout(location = 3) out vec4 out_emissive;

#ifdef GLOAM_MOTION
layout(location = 5) in vec3 in_clip;  // x, y, w
layout(location = 6) in vec3 in_previous_clip;
layout(set = 0, binding = 1, scalar) uniform MotionBlock { MotionConstants motion; };
layout(location = 4) out vec2 out_motion;
#endif

void main() {
  // pack_normal takes normals of any length.
  Surface s =
      fetch_surface_unscaled(to_viewer(view, in_relative), view.normal_variance, view.light_scale, view.mip_bias);
  out_base_color = encode_base_color(s.base_color.rgb, s.subsurface, s.normal_spread);
  out_normals = encode_normals(s.normal, s.face_normal);
  out_material = vec4(s.roughness, s.metallic, s.occlusion, s.reflectivity);
  out_emissive = vec4(min(s.emissive, vec3(65504.0)), s.extinction_root);
  if ((kSurface & GLOAM_SURFACE_CLIPPED) != 0u && is_clipped(view, in_relative)) discard;
#ifdef GLOAM_MOTION
  out_motion = screen_motion(motion, in_clip, in_previous_clip);
#endif
}
