// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"

namespace gloam {

/// Names and legends of the views of final lists that have a name of their own.
[[nodiscard]] std::vector<VisualizerInfo> final_list_visualizers();

/// After the frame's shadows: when it has final lists, takes view light_list over from the lights module
/// (LightListViewTaken).
void take_light_list_view(FrameBuilder& frame);

/// Adds the pass of FrameBuilder::visualizer(), if that is "visibility_slots", "lights_final" or, where it was taken
/// over, "light_list:LIGHT" of a light in view: over the picture, and into an image of the view's name, which a capture
/// of the frame shows. Without final lists the picture stays as it is, and `warn` is told why.
[[nodiscard]] Status add_final_list_view_pass(FrameBuilder& frame,
                                              const std::function<void(const std::string& sentence)>& warn);

}  // namespace gloam
