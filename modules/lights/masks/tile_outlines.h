// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/render/view.h"

namespace gloam {

struct MaskLight;

/// How view space becomes tiles. "Slope" is x / d and y / d of a perspective camera (d: view depth), x and y in metres
/// of an orthographic one. Columns are counted from the left: column = slope · column_scale + column_offset, rows from
/// the top likewise.
struct TileProjection {
  bool perspective = true;
  double near_m = 0.1;
  double column_scale = 1.0;
  double column_offset = 0.0;
  double row_scale = -1.0;
  double row_offset = 0.0;
  std::uint32_t columns = 1;
  std::uint32_t rows = 1;
  double width = 1.0;  ///< of the picture, in columns: the last one may be cut
  double height = 1.0;
  double greatest_ray = 1.0;  ///< length of the longest (slope x, slope y, 1) on the screen
};

[[nodiscard]] TileProjection tile_projection(const RenderView& view);

/// Outlines of lights in tiles, an item a light; a column a property, because loops compute many lights at once.
///
/// The outline of a sphere before the near plane is an ellipse. At a slope s of rows it reaches from
///   middle + lean · s − half · √q  to  middle + lean · s + half · √q  columns,  q = radius2 · (1 + s²) − (s −
///   row_slope)²
/// (without s² in an orthographic view). A cone adds two lines through its apex: `bound` + `slope` · s columns, on the
/// left or right.
struct TileOutlines {
  std::vector<double> x, y, depth, radius;  ///< of the bounds, view space, metres
  std::vector<double> farthest;             ///< view depth that nothing of the light is beyond
  /// Half-open rectangles, in tiles; those of lights that touch none are empty.
  std::vector<std::int32_t> column_begin, column_end, row_begin, row_end;

  std::vector<float> middle, lean, half, radius2, row_slope;
  std::vector<float> least_slope, greatest_slope;  ///< between which the outline lies
  std::vector<std::int32_t> leftmost_row,
      rightmost_row;  ///< rows that hold the outline's leftmost and rightmost points

  std::vector<double> apex_x, apex_y, apex_depth, toward_x, toward_y, toward_depth, sine;
  struct Line {
    std::vector<float> left_slope, left_bound, right_slope, right_bound;
  };
  Line lines[2];

  void resize(std::size_t count);
};

/// What is computed of outlines, from what a knob asks for.
enum class OutlineDetail : std::uint8_t { rectangles, ellipses, cones };

/// Fills the outlines of lights [range.begin, range.end). All are conservative: they hold every pixel whose ray meets
/// the light behind the near plane, and NaN or infinity in a light gives it the whole picture.
void find_outlines(std::span<const MaskLight> lights, const RenderView& view, const TileProjection& projection,
                   OutlineDetail detail, JobRange range, TileOutlines& outlines);

}  // namespace gloam
