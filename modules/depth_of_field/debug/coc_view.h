// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/module.h"
#include "modules/depth_of_field/frame.h"

namespace gloam {

[[nodiscard]] std::vector<VisualizerInfo> dof_visualizers();

/// PassPhase::visualize.
void add_dof_view_pass(FrameBuilder& frame, const DofFrame& dof);

}  // namespace gloam
