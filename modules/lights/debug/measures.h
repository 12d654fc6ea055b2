// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/knobs/measure.h"

namespace gloam {

/// Error measures for the knobs lights.culling, lights.tile_bound and lights.z_bins: the false positives per tile with
/// a surface, i.e. lights that are candidates (after tile masks and zBins) or are shaded, but reach none of the tile's
/// pixels. The reference is the lists of the accurate search, which tests every pixel. The brute-force check
/// (lights.check) counts lights that are missing from these lists; a frame with a missing light is faulty.
[[nodiscard]] std::vector<MeasureInfo> light_measures();

}  // namespace gloam
