// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/math/view_projection.h"

namespace gloam {

struct MaskLight;

/// Mapping from view space to tiles. A "slope" is x / d or y / d for a perspective camera (d: view depth), and x or y
/// in metres for an orthographic one. Columns are counted from the left: column = slope · column_scale + column_offset.
/// Rows are counted from the top, with row_scale and row_offset.
struct TileProjection {
  bool perspective = true;
  double near_m = 0.1;
  double column_scale = 1.0;
  double column_offset = 0.0;
  double row_scale = -1.0;
  double row_offset = 0.0;
  std::uint32_t columns = 1;
  std::uint32_t rows = 1;
  double width = 1.0;  ///< image width in columns of tiles; fractional if the last column is cut off
  double height = 1.0;
  double greatest_ray = 1.0;  ///< length of the longest vector (slope x, slope y, 1) on the screen
};

[[nodiscard]] TileProjection tile_projection(const ViewProjection& view);

/// Outlines of lights in tile coordinates, one item per light. Each property is a separate array (structure of arrays),
/// so that loops process many lights at once.
///
/// The outline of a sphere beyond the near plane is an ellipse. At row slope s it covers the columns
///   middle + lean · s − half · √q  to  middle + lean · s + half · √q,
///   with q = radius2 · (1 + s²) − (s − row_slope)² (orthographic: radius2 − (s − row_slope)²).
/// A cone adds two lines through its apex, each a left or right bound in columns: `bound` + `slope` · s.
struct TileOutlines {
  std::vector<double> x, y, depth, radius;  ///< of the bounds; view space, metres
  std::vector<double> farthest;             ///< upper bound of the light's view depth
  /// Half-open rectangles in tiles; empty for a light that touches no tile.
  std::vector<std::int32_t> column_begin, column_end, row_begin, row_end;

  std::vector<float> middle, lean, half, radius2, row_slope;
  std::vector<float> least_slope, greatest_slope;  ///< row slopes between which the outline lies
  std::vector<std::int32_t> leftmost_row,
      rightmost_row;  ///< rows with the outline's leftmost and rightmost points

  std::vector<double> apex_x, apex_y, apex_depth, toward_x, toward_y, toward_depth, sine;
  struct Line {
    std::vector<float> left_slope, left_bound, right_slope, right_bound;
  };
  Line lines[2];

  void resize(std::size_t count);
};

/// How much of the outlines is computed; follows from knob lights.tile_bound.
enum class OutlineDetail : std::uint8_t { rectangles, ellipses, cones };

/// Fills the outlines of lights [range.begin, range.end). All are conservative: they contain every pixel whose ray
/// meets the light beyond the near plane. A light with NaN or infinity covers the whole image.
void find_outlines(std::span<const MaskLight> lights, const ViewProjection& view, const TileProjection& projection,
                   OutlineDetail detail, JobRange range, TileOutlines& outlines);

}  // namespace gloam
