// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_VIEW_SHARED_H
#define GLOAM_SHADERS_RENDER_VIEW_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// One view of one frame. Positions are relative to the camera, axes are the world's.
struct ViewConstants {
  mat4 clip_from_relative;
  // Camera-relative position of pixel (x, y) at depth z: (base + x dx + y dy) · s + forward · t, where s = base.w / z
  // (1 when base.w is 0: orthographic) and t = dx.w + z dy.w.
  vec4 ray_base;
  vec4 ray_dx;
  vec4 ray_dy;
  vec4 ray_forward;
  vec4 view_row_z;  // dot(xyz, p) = z of p in view space (negative in front of the camera)
  uvec2 size;       // pixels
  vec2 inverse_size;
  float near_m;
  uint orthographic;  // 0 or 1
  uint visualizer;    // code in debug_view.frag; 0: none of its visualizers
  // dot(xyz, p) + w >= 0: the visible side; p is relative to the camera. Of views that are clipped.
  vec4 clip_plane;
  float normal_variance;  // HighlightFilter
  float light_scale;      // RenderView::light_scale
  float mip_bias;         // RenderView::mip_bias
};

GLOAM_SHARED_END

#endif
