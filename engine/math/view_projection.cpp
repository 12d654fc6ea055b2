// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/math/view_projection.h"

#include "engine/core/assert.h"

namespace gloam {

ViewProjection view_projection(const dmat4& world_from_camera, const mat4& clip_from_view, float near_m,
                               std::uint32_t width, std::uint32_t height) {
  GLOAM_ASSERT(width > 0 && height > 0, "view_projection: a view has at least one pixel");
  ViewProjection view;
  view.width = width;
  view.height = height;
  view.position = dvec3(world_from_camera[3]);
  dmat4 rotation = world_from_camera;
  rotation[3] = dvec4(0.0, 0.0, 0.0, 1.0);
  view.view_from_relative = mat4(glm::transpose(rotation));
  view.clip_from_view = clip_from_view;
  view.clip_from_relative = view.clip_from_view * view.view_from_relative;
  view.near_m = near_m;
  view.frustum = frustum_from_clip(view.clip_from_relative);
  return view;
}

}  // namespace gloam
