// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "engine/render/view.h"

namespace gloam::test {

/// Whether a point relative to the view's position is inside the picture, with a margin for float rounding.
[[nodiscard]] inline bool surely_visible(const RenderView& view, const dvec3& relative) {
  const dvec4 clip = dmat4(view.clip_from_relative) * dvec4(relative, 1.0);
  const double margin = 1e-4 * (1.0 + glm::length(relative));
  return clip.w > 0.0 && std::abs(clip.x) < clip.w - margin && std::abs(clip.y) < clip.w - margin &&
         clip.z < clip.w - margin && (clip.z > margin || !view.camera.orthographic);
}

[[nodiscard]] inline double view_depth(const RenderView& view, const dvec3& relative) {
  return -glm::dot(dvec3(glm::transpose(dmat4(view.view_from_relative))[2]), relative);
}

}  // namespace gloam::test
