// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/math/types.h"

namespace gloam {

/// Connectivity of a triangle list, derived on demand by algorithms that need it (growth surfaces, proxy fitting).
/// Drawn geometry never passes through it.
struct Topology {
  std::vector<vec3> positions;                          ///< welded: bit-equal positions (−0 as 0) become one vertex
  std::vector<std::array<std::uint32_t, 3>> faces;      ///< kept faces, in input order
  std::vector<std::uint32_t> source_faces;              ///< input triangle of each kept face
  std::vector<vec3> face_normals;                       ///< unit; kept faces are never degenerate
  std::vector<std::array<std::uint32_t, 3>> neighbors;  ///< kept face across edge (i, i+1); ~0 at a border
  std::uint32_t degenerate_faces = 0;                   ///< dropped: no area
  std::uint32_t refused_faces = 0;  ///< dropped: third face on an edge, or would make a vertex non-manifold
};

/// indices: triangle list into positions, a multiple of three, every index in range (asserted).
[[nodiscard]] Topology build_topology(std::span<const vec3> positions, std::span<const std::uint32_t> indices);

}  // namespace gloam
