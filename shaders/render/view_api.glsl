// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_VIEW_API_GLSL
#define GLOAM_SHADERS_RENDER_VIEW_API_GLSL

#include "shaders/render/view_shared.h"

// Camera-relative position of what lies at `depth` (reversed Z) under the pixel centre `pixel` + 0.5.
vec3 relative_position(ViewConstants view, vec2 pixel, float depth) {
  vec2 ndc = (pixel + 0.5) * view.inverse_size * vec2(2.0, -2.0) + vec2(-1.0, 1.0);
  vec4 p = view.relative_from_clip * vec4(ndc, depth, 1.0);
  return p.xyz / p.w;
}

// Direction from the camera through a pixel; not normalised.
vec3 view_ray(ViewConstants view, vec2 pixel) {
  return relative_position(view, pixel, 0.5);
}

// Towards the camera from a camera-relative position; not normalised.
vec3 to_viewer(ViewConstants view, vec3 relative) { return view.orthographic != 0u ? view.view_row_z.xyz : -relative; }

// Metres in front of the camera of a camera-relative position.
float view_depth(ViewConstants view, vec3 relative) { return -dot(view.view_row_z.xyz, relative); }

#endif
