// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Depth and coverage of a blended surface: see FrontDepth.

#include "shaders/render/surface_api.glsl"
#include "shaders/render/view_api.glsl"

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };

layout(location = 0) out vec4 out_depth;

void main() {
  Surface s = fetch_surface_unscaled(to_viewer(view, in_relative), 0.0, 1.0, view.mip_bias);
  out_depth = vec4(gl_FragCoord.z, 0.0, 0.0, s.base_color.a);
  if ((kSurface & GLOAM_SURFACE_CLIPPED) != 0u && is_clipped(view, in_relative)) discard;
}
