// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/frame_builder.h"
#include "modules/lights/bins/z_bins.h"
#include "modules/lights/masks/tile_light_masks.h"
#include "modules/lights/selection/light_list.h"

namespace gloam {

/// Adds the pipelines that add_find_lights_passes uses with these knobs.
void list_light_pipelines(const KnobRegistry& knobs, const gpu::DeviceInfo& device, PipelineList& list);

/// Uploads the view's lights. If there are local lights, adds pass light_texels; if also lights.culling = tiled, adds
/// passes find_lights_approx and find_lights_accurate, which list the lights of each shadow tile, and check_lists if
/// lights.check = on. Puts LightsOutputs on the board.
void add_find_lights_passes(FrameBuilder& frame, const VisibleLights& visible, const ZBins& bins,
                            const TileLightMasks& masks);

}  // namespace gloam
