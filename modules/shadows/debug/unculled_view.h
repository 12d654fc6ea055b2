// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/core/once_log.h"
#include "engine/render/frame_builder.h"
#include "engine/render/module.h"

namespace gloam {

/// Names and legends of visualizers "shadow_unculled" (FF §5.1, its second mode) and "shadow_filtered", the same
/// without the filter's early-outs.
[[nodiscard]] std::vector<VisualizerInfo> unculled_visualizers();

/// Adds the passes of the visualizer if FrameBuilder::visualizer() is one of these. They evaluate the light's
/// visibility at every pixel from its shadow maps and, if UnculledCloseups are on the board, its close-up maps, and
/// compare it with the visibility that the final lists hold. Draws over the picture and into the image
/// "shadow_unculled" (rgba32f; both visualizers): red the visibility without culling, green the drawn one, blue the
/// absolute difference; −1, −1, 0 where the light does not reach. Without final lists the picture stays as it is, and
/// one warning gives the reason.
void add_unculled_view_passes(FrameBuilder& frame, OnceLog& once_log);

}  // namespace gloam
