// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/math/types.h"

namespace gloam {

/// The used vertices of a mesh, those at one position merged. The simplifier treats several vertices at one position as
/// a seam, even unused ones.
struct MergedMesh {
  std::vector<vec3> positions;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> original;  ///< by merged vertex: one of the vertices of the mesh there
};
[[nodiscard]] MergedMesh merged_by_position(std::span<const vec3> positions, std::span<const std::uint32_t> indices);

}  // namespace gloam
