// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"
#include "modules/lights/bins/z_bins.h"
#include "modules/lights/masks/tile_light_masks.h"
#include "modules/lights/selection/light_list.h"

namespace gloam {

/// Pipelines of the passes below that the knobs call for.
void list_light_pipelines(const KnobRegistry& knobs, const gpu::DeviceInfo& device, PipelineList& list);

/// Uploads the lights of the view and, with local lights and lights.culling = tiled, finds those of every shadow tile:
/// passes light_texels, find_lights_approx, find_lights_accurate, and with lights.check also check_lists. Puts
/// LightsOutputs.
[[nodiscard]] Status add_find_lights_passes(FrameBuilder& frame, const VisibleLights& visible, const ZBins& bins,
                                            const TileLightMasks& masks);

}  // namespace gloam
