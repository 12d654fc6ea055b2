// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/view.h"
#include "shaders/render/motion_shared.h"
#include "shaders/render/view_shared.h"

namespace gloam {

/// Shader constants of a view, computed in double. `visualizer` is left 0.
[[nodiscard]] shaders::ViewConstants view_constants(const RenderView& view);
/// Shader constants of a view's motion since the previous frame (motion_api.glsl).
[[nodiscard]] shaders::MotionConstants motion_constants(const RenderView& view);

}  // namespace gloam
