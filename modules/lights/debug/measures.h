// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/knobs/measure.h"

namespace gloam {

/// What tells the values of lights.culling, lights.tile_bound and lights.z_bins apart: how many lights a tile with a
/// surface is left with that reach none of its pixels (after the tile masks and zBins, or of all that shading loops
/// over), held against the lists of the accurate search, which asks every pixel. Brute force (lights.check) tells
/// whether those lack a light: such a frame is wrong.
[[nodiscard]] std::vector<MeasureInfo> light_measures();

}  // namespace gloam
