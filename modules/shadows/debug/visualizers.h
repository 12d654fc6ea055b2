// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "modules/shadows/maps/state.h"

namespace gloam {

/// Names and legends of the views of this module.
[[nodiscard]] std::vector<VisualizerInfo> shadow_visualizers();

/// Adds the pass of FrameBuilder::visualizer(), if that is one of this module's: "shadow:LIGHT" draws one light's
/// visibility over the picture and into the exposed image "shadow_visibility" (r32f; −1 where the light does not
/// reach), "shadow_atlas" the maps of the frame. Where there are final lists, visibility is what they hold; tiles
/// without a list are asked about as in shadows.mode = monolithic.
[[nodiscard]] Status add_shadow_view_pass(FrameBuilder& frame, const ShadowStates& states);

}  // namespace gloam
