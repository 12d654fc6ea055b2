// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/view.h"
#include "shaders/render/view_shared.h"

namespace gloam {

/// A view as shaders see it; `visualizer` is left 0. Computed in double.
[[nodiscard]] shaders::ViewConstants view_constants(const RenderView& view);

}  // namespace gloam
