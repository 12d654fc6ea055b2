// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "modules/shadows/maps/state.h"

namespace gloam {

/// Names and legends of the visualizers of shadow maps.
[[nodiscard]] std::vector<VisualizerInfo> shadow_visualizers();

/// Adds the visualizer's pass if FrameBuilder::visualizer() is one of these. "shadow:LIGHT" draws one light's
/// visibility over the picture and into the exposed image "shadow_visibility" (r32f; −1 where the light does not
/// reach); "shadow_atlas" draws the frame's maps. With final lists, "shadow" shows the visibilities that they hold;
/// fallback tiles are evaluated as in shadows.mode=monolithic.
[[nodiscard]] Status add_shadow_view_pass(FrameBuilder& frame, const ShadowStates& states);

}  // namespace gloam
