// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/render/view.h"
#include "modules/grass/knobs.h"
#include "shaders/grass/lod/lod_shared.h"

namespace gloam {

/// Segments of the blades of each draw class, from near to far. Divisors of 15, so that their knots are simulated ones.
inline constexpr std::array<std::uint32_t, GLOAM_GRASS_CLASSES> kClassSegments = {15, 5, 3, 1};

/// What the level of detail of a view is made for.
struct DetailRange {
  float range_m = 0.0f;          ///< greatest distance of its patches
  float blade_m = 0.0f;          ///< length of its longest blade
  double metres_per_unit = 1.0;  ///< of the view; > 0
};

/// Level of detail of a view.
[[nodiscard]] shaders::GrassLod grass_lod(const RenderView& view, const GrassKnobs& knobs, const DetailRange& range);

/// Indices of GLOAM_GRASS_DRAW_BLADES blades for each class, one class after the other: two triangles per segment.
/// Vertex 2 (segments + 1) · blade + 2 · knot + side.
[[nodiscard]] std::vector<std::uint32_t> blade_indices();

}  // namespace gloam
