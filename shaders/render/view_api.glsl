// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_VIEW_API_GLSL
#define GLOAM_SHADERS_RENDER_VIEW_API_GLSL

#include "shaders/render/view_shared.h"

// Whether a camera-relative position lies behind the clip plane of a clipped view.
bool is_clipped(ViewConstants view, vec3 relative) {
  return dot(view.clip_plane.xyz, relative) + view.clip_plane.w < 0.0;
}

// Camera-relative position of the point at `depth` (reversed Z) under the pixel centre `pixel` + 0.5.
vec3 relative_position(ViewConstants view, vec2 pixel, float depth) {
  float scale = view.ray_base.w > 0.0 ? view.ray_base.w / depth : 1.0;
  // Precise: passes that shade a pixel in different shaders must get the same position.
  precise vec3 position = (view.ray_base.xyz + pixel.x * view.ray_dx.xyz + pixel.y * view.ray_dy.xyz) * scale +
                          view.ray_forward.xyz * (view.ray_dx.w + depth * view.ray_dy.w);
  return position;
}

// View depth in metres of a point at `depth`. Rounds at most twice, while view_depth() of a position loses several
// digits in the corners of a wide lens.
float surface_view_depth(ViewConstants view, float depth) {
  return view.ray_base.w > 0.0 ? view.ray_base.w / depth : view.ray_dx.w + depth * view.ray_dy.w;
}

// Distance in metres from the camera to the point at `depth` under a pixel. Only for perspective cameras.
float perspective_distance(ViewConstants view, vec2 pixel, float depth) {
  return length((view.ray_base.xyz + pixel.x * view.ray_dx.xyz + pixel.y * view.ray_dy.xyz) *
                (view.ray_base.w / depth));
}

// Direction from the camera through a pixel; not normalised.
vec3 view_ray(ViewConstants view, vec2 pixel) { return relative_position(view, pixel, 0.5); }

// Direction from a camera-relative position to the camera; not normalised.
vec3 to_viewer(ViewConstants view, vec3 relative) { return view.orthographic != 0u ? view.view_row_z.xyz : -relative; }

// View depth in metres of a camera-relative position.
float view_depth(ViewConstants view, vec3 relative) { return -dot(view.view_row_z.xyz, relative); }

#endif
