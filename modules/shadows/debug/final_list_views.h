// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/core/once_log.h"
#include "engine/render/frame_builder.h"
#include "engine/render/module.h"

namespace gloam {

/// Names and legends of the visualizers of final lists, except light_list, which belongs to the lights module.
[[nodiscard]] std::vector<VisualizerInfo> final_list_visualizers();

/// Why a frame with shadows has no final lists, for warnings.
[[nodiscard]] std::string reason_without_lists(const FrameBuilder& frame);

/// Puts LightListViewTaken on the board when the frame has final lists: this module then draws visualizer light_list
/// instead of the lights module. Call after add_shadow_passes().
void take_light_list_view(FrameBuilder& frame);

/// Adds the visualizer's pass if FrameBuilder::visualizer() is "visibility_slots", "lights_final" or, after
/// take_light_list_view() has taken it over, "light_list:LIGHT" for a light in view. It draws over the picture and into
/// an image of the visualizer's name, for captures. Without final lists the picture stays as it is, and one warning
/// gives the reason.
void add_final_list_view_pass(FrameBuilder& frame, OnceLog& once_log);

}  // namespace gloam
