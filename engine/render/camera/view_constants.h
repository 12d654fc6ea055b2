// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/view.h"
#include "shaders/render/motion_shared.h"
#include "shaders/render/view_shared.h"

namespace gloam {

/// How much the change of the normal from pixel to pixel widens highlights: `variance` times twice the solid angle of
/// the normals in a pixel is the square of the width that is added (normal_spread_in_pixel in surface_api.glsl). A view
/// resource; a view without it has 0.
struct HighlightFilter {
  float variance = 0.0f;
};

/// Shader constants of a view, computed in double. `visualizer` is left 0.
[[nodiscard]] shaders::ViewConstants view_constants(const RenderView& view);
/// Shader constants of a view's motion since the previous frame (motion_api.glsl).
[[nodiscard]] shaders::MotionConstants motion_constants(const RenderView& view);

}  // namespace gloam
