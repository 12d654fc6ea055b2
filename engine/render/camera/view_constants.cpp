// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/camera/view_constants.h"

namespace gloam {

shaders::ViewConstants view_constants(const RenderView& view) {
  shaders::ViewConstants constants{};
  constants.clip_from_relative = view.clip_from_relative;
  const mat4 rows = glm::transpose(view.view_from_relative);
  constants.view_row_z = rows[2];
  constants.size = {view.width, view.height};
  constants.inverse_size = 1.0f / vec2(static_cast<float>(view.width), static_cast<float>(view.height));
  constants.near_m = view.near_m;
  constants.orthographic = view.camera.orthographic ? 1 : 0;
  constants.clip_plane = view.clip_plane;
  constants.light_scale = view.light_scale;
  constants.mip_bias = view.mip_bias;

  const dvec3 right(rows[0]), up(rows[1]);
  const dmat4 clip(view.clip_from_view);
  // A sheared projection (ViewSettings::lens) has its axis off the middle of the picture.
  const dvec3 forward = -dvec3(rows[2]) + right * (clip[2][0] / clip[0][0]) + up * (clip[2][1] / clip[1][1]);
  const dvec3 whole_width = right * (2.0 / clip[0][0]), whole_height = up * (2.0 / clip[1][1]);
  const double width = view.width, height = view.height;
  const dvec3 corner = whole_width * (0.5 / width - 0.5) + whole_height * (0.5 - 0.5 / height);
  constants.ray_dx = vec4(vec3(whole_width / width), 0.0f);
  constants.ray_dy = vec4(vec3(-whole_height / height), 0.0f);
  if (view.camera.orthographic) {
    constants.ray_base = vec4(vec3(corner), 0.0f);
    constants.ray_forward = vec4(vec3(forward), 0.0f);
    constants.ray_dx.w = static_cast<float>(clip[3][2] / clip[2][2]);
    constants.ray_dy.w = static_cast<float>(-1.0 / clip[2][2]);
  } else {
    constants.ray_base = vec4(vec3(corner + forward), view.near_m);
  }
  return constants;
}

shaders::MotionConstants motion_constants(const RenderView& view) {
  shaders::MotionConstants constants{};
  constants.previous_clip_from_relative = view.previous.clip_from_relative;
  constants.moved = vec3(view.position - view.previous.position);
  constants.half_size = 0.5f * vec2(static_cast<float>(view.width), -static_cast<float>(view.height));
  constants.orthographic = view.camera.orthographic || view.previous.orthographic ? 1 : 0;
  return constants;
}

}  // namespace gloam
