// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/render/packing/detail_level.h"
#include "engine/scene/assets.h"

namespace gloam {

struct MadeLevels {
  DetailLevels levels;
  std::vector<std::uint32_t> indices;  ///< of all levels
};

/// Levels of detail, each with about half the triangles of the one before. Their vertices are those of the primitive,
/// renumbered as pack_primitive() does. Open borders are kept, so that no gaps open where pieces meet; closed surfaces
/// stay closed. For maps, vertices at one position count as one, even if other attributes differ; for views they are
/// seams, which are simplified less. No levels if a primitive is small, morphs, or cannot be simplified.
[[nodiscard]] MadeLevels make_levels(const Primitive& source, LevelUse use);

}  // namespace gloam
