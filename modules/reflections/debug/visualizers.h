// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "modules/reflections/reference/adapter.h"

namespace gloam {

/// Names and legends of this module's visualizers. extras: what traced rays see beside the surfaces of the scene.
[[nodiscard]] std::vector<VisualizerInfo> reflection_visualizers(const ExtrasOf& extras);

/// Marks the picture with traced reflections as a picture (VisualizerIsPicture).
void announce_reflection_view(FrameBuilder& frame);

/// Adds the pass of FrameBuilder::visualizer() if the visualizer belongs to this module. A frame without reflections is
/// left unchanged. Each visualizer also writes its plain values into an image of its name.
void add_reflection_view_pass(FrameBuilder& frame);

}  // namespace gloam
