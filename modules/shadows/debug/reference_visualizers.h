// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/core/once_log.h"
#include "engine/render/frame_builder.h"
#include "engine/render/module.h"

namespace gloam {

/// Names and legends of the visualizers of traced visibility (VisualizerInfo::trace).
[[nodiscard]] std::vector<VisualizerInfo> shadow_reference_visualizers();

/// Adds the visualizer's pass if FrameBuilder::visualizer() is one of these. "shadow_reference:LIGHT" draws one light's
/// traced visibility over the picture and into the image "shadow_reference" (r32f; −1 where the light does not reach).
/// "error" draws how far drawn visibilities differ from traced ones, also into the image "shadow_error" (r32f: mean
/// over the traced lights that reach the pixel; −1 where there is none). Usage error when nothing was traced for the
/// view.
void add_shadow_reference_view_pass(FrameBuilder& frame, OnceLog& once_log);

}  // namespace gloam
