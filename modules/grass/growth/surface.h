// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/math/types.h"

namespace gloam {

/// Grass grows on a triangle if the world-space normal's y is at least this.
inline constexpr float kGrowthCosine = 0.35f;

/// No triangle: the edge is a border of the surface.
inline constexpr std::uint32_t kNoTriangle = ~0u;

/// One upward-facing triangle of a mesh in the world.
struct GrowthTriangle {
  std::array<dvec3, 3> corners{};  ///< metres, relative to GrowthSurface::origin
  vec3 normal = vec3(0.0f);        ///< unit
  double area_m2 = 0.0;
  std::array<std::uint32_t, 3> neighbors{};      ///< triangle across the edge from corner i to i + 1, or kNoTriangle
  std::array<std::uint8_t, 3> neighbor_edges{};  ///< the same edge's number in that triangle
};

/// Triangles that grass can grow on. field/mesh_surface.h makes them of a mesh.
struct GrowthSurface {
  dvec3 origin = dvec3(0.0);  ///< world position of the mesh's origin
  std::vector<GrowthTriangle> triangles;
  double area_m2 = 0.0;                ///< of all triangles
  std::uint32_t refused_faces = 0;     ///< non-manifold: left out
  std::uint32_t degenerate_faces = 0;  ///< no area
  std::uint32_t non_finite_faces = 0;  ///< a corner is NaN or infinite
};

}  // namespace gloam
