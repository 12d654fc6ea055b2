// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Places of probes for diffuse light in a scene that has none.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/math/types.h"
#include "engine/render/reference/scene_tracer.h"

namespace gloam {

/// A cell of a grid, and the place in it at which light is captured.
struct GridCell {
  dvec3 center = dvec3(0.0);
  dvec3 half = dvec3(0.0);
  dvec3 eye = dvec3(0.0);
};

/// World-space bounds of a triangle, or of several.
struct SurfaceBounds {
  dvec3 least = dvec3(0.0);
  dvec3 most = dvec3(0.0);
};

/// Bounds of all triangles of mesh instances in their rest poses; those that are not finite are left out.
[[nodiscard]] std::vector<SurfaceBounds> triangle_bounds(const World& world);

/// The cells that hold surfaces, of the finest grid that has at most `most` of them: cells are about cubes and fill the
/// bounds of all surfaces. None without surfaces. eye: the cell's middle. unit_m: scene_unit(); flat scenes get cells
/// two of it high.
[[nodiscard]] std::vector<GridCell> occupied_cells(std::span<const SurfaceBounds> surfaces, std::uint32_t most,
                                                   double unit_m);

/// Share of 64 rays from a point that leave a body by the back of its surface: 0 in the open, 1 inside a wall, 1/2
/// below a ground without thickness. reach_m: length of the rays.
[[nodiscard]] double inside_share(const SceneTracer& tracer, const dvec3& point, double reach_m);

/// Moves eyes that lie inside of walls to the place in their cell with the least inside_share(), of 27, and leaves out
/// cells without a place below a quarter.
[[nodiscard]] std::vector<GridCell> open_cells(std::vector<GridCell> cells, const SceneTracer& tracer);

}  // namespace gloam
