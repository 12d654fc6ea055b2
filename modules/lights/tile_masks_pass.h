// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/frame_builder.h"
#include "modules/lights/light_list.h"

namespace gloam {

[[nodiscard]] gpu::ComputePipelineDesc tile_masks_pipeline();
[[nodiscard]] gpu::ComputePipelineDesc light_texels_pipeline();

/// Uploads the view's lights and, when lights.culling = tiled, finds which may touch each tile; puts LightsOutputs.
[[nodiscard]] Status add_tile_masks_pass(FrameBuilder& frame, const VisibleLights& visible);

/// Shows the number of lights of each tile instead of the picture (view tile_masks).
[[nodiscard]] Status add_tile_masks_view_pass(FrameBuilder& frame);

}  // namespace gloam
