// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/surface_api.glsl"
#include "shaders/render/view_api.glsl"

// Writes the surface of a fragment to the geometry buffer (layout in gbuffer_api.glsl).

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };

layout(location = 0) out vec4 out_base_color;
layout(location = 1) out uvec4 out_normals;
layout(location = 2) out vec4 out_material;
layout(location = 3) out vec4 out_emissive;

void main() {
  Surface s = fetch_surface_unscaled(to_viewer(view, in_relative));  // pack_normal takes normals of any length
  out_base_color = vec4(sqrt(max(s.base_color.rgb, vec3(0.0))), s.subsurface ? 1.0 : 0.0);
  out_normals = uvec4(pack_normal(s.normal), pack_normal(s.face_normal), 0u, 0u);
  out_material = vec4(s.roughness, s.metallic, s.occlusion, s.reflectivity);
  out_emissive = vec4(s.emissive, 0.0);
  if ((kSurface & GLOAM_SURFACE_CLIPPED) != 0u && is_clipped(view, in_relative)) discard;
}
