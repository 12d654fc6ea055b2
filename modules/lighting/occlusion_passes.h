// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"

namespace gloam {

/// Share of the surroundings' light that nearby surfaces hide from each pixel's surface, r8_unorm; 0 without a surface.
struct AmbientOcclusion {
  ImageRef hidden;
};

/// Whether the frame's view has AmbientOcclusion.
[[nodiscard]] bool occludes_ambient(const FrameBuilder& frame);
/// Estimates AmbientOcclusion and puts it on the board, if the view has it.
void add_occlusion_passes(FrameBuilder& frame);

/// The view `occlusion`.
[[nodiscard]] std::vector<VisualizerInfo> occlusion_visualizers();
void add_occlusion_view_pass(FrameBuilder& frame);

}  // namespace gloam
