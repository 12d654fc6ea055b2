// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/once_log.h"
#include "engine/render/frame_builder.h"
#include "engine/render/module.h"

namespace gloam {

/// Name and legend of visualizer "shadow_unculled" (FF §5.1, its second mode).
[[nodiscard]] VisualizerInfo unculled_visualizer();

/// Adds the passes of visualizer "shadow_unculled:LIGHT" if FrameBuilder::visualizer() is it. They evaluate the light's
/// visibility at every pixel from its shadow maps and, if UnculledCloseups are on the board, its close-up maps, and
/// compare it with the visibility that the final lists hold. Draws over the picture and into the image
/// "shadow_unculled" (rgba32f): red the visibility without culling, green the drawn one, blue the absolute difference;
/// −1, −1, 0 where the light does not reach. Without final lists the picture stays as it is, and one warning gives the
/// reason.
void add_unculled_view_passes(FrameBuilder& frame, OnceLog& once_log);

}  // namespace gloam
