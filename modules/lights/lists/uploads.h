// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "engine/render/frame_builder.h"
#include "modules/lights/bins/z_bins.h"
#include "modules/lights/masks/tile_light_masks.h"
#include "modules/lights/outputs.h"

namespace gloam {

/// Hash of a view's tile light masks, computed once per build of the masks; a view resource. All copies share it, so
/// that it can be updated while passes are declared.
struct TileMaskHash {
  struct Computed {
    std::uint64_t lists = 0;  ///< of the hashed masks (TileLightMasks::lists, TileLightMasks::bound)
    TileBound bound = TileBound::rect;
    std::uint64_t hash = 0;
  };
  std::shared_ptr<Computed> computed = std::make_shared<Computed>();
};

/// Fills LightsOutputs::z_bins and LightsOutputs::mask_tiles with buffers of the view that keep their contents between
/// frames. Pass light_uploads copies the arrays that differ from what the buffers hold; without such an array there is
/// no pass.
void add_light_uploads(FrameBuilder& frame, const ZBins& bins, const TileLightMasks& masks, LightsOutputs& outputs);

}  // namespace gloam
