// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/view.h"
#include "shaders/render/motion_shared.h"
#include "shaders/render/view_shared.h"

namespace gloam {

/// How much the change of the normal from pixel to pixel widens highlights: the square of a surface's GGX width grows
/// by `variance` times the sum of the squares of both changes. A view resource; a view without it has 0.
struct HighlightFilter {
  float variance = 0.0f;
};

/// Shader constants of a view, computed in double. `visualizer` is left 0.
[[nodiscard]] shaders::ViewConstants view_constants(const RenderView& view);
/// Shader constants of a view's motion since the previous frame (motion_api.glsl).
[[nodiscard]] shaders::MotionConstants motion_constants(const RenderView& view);

}  // namespace gloam
