// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Screen rectangles of spheres: Mara and McGuire, "2D Polyhedral Bounds of a Clipped, Perspective-Projected 3D Sphere"
// (JCGT 2(2), 2013), its axis-aligned case, in double and without branches, so that the compiler vectorizes it.
// engine/math/screen_bounds.h has the careful version for one sphere; this one instead widens the bounds by more than
// the sum of all rounding errors.
#include "modules/lights/masks/tile_outlines.h"

#include <algorithm>
#include <cmath>

#include "modules/lights/cpu_clones.h"
#include "modules/lights/masks/tile_light_masks.h"

namespace gloam {
namespace {

/// Relative rounding error of a camera-relative position in the GPU's floats; bounds grow by it.
constexpr double kRounding = 4e-7;
constexpr double kTilesAPixel = 1.0 / GLOAM_LIGHT_TILE;
constexpr double kMargin = kTilesAPixel / 64;
constexpr double kLineMargin = kTilesAPixel / 16;  // more than the rounding error of columns in floats
/// An ellipse is used only if the sphere's depth is at least this multiple of its radius: the ellipses of nearer
/// spheres are too elongated for floats. Nearer spheres keep their rectangle.
constexpr double kClearance = 1.05;
constexpr double kEverywhere = 1e9;  // columns
/// Rounding error of the cosine of a cone angle, in floats here and in the GPU's comparison.
constexpr double kCosineRounding = 4e-7;
/// Sine of the angle by which the tangent lines of a cone are opened.
constexpr double kLineRounding = 1e-5;
constexpr double kLeastAcross =
    0.02;  // least sine of the angle between cone axis and view ray; below it the lines lose too many digits

// A comparison with NaN is false: both return b if a or b is NaN.
GLOAM_CPU_INLINE double smaller(double a, double b) { return a < b ? a : b; }
GLOAM_CPU_INLINE double greater(double a, double b) { return a > b ? a : b; }

/// Greatest slope of the part of a disc with depth ≥ near; tt = x² + d² − r².
GLOAM_CPU_INLINE double greatest_slope(double x, double d, double r, double near, double over_near, double tt) {
  const double t = std::sqrt(greater(tt, 0.0));
  const double xd = x * d;
  const bool same_sign = xd >= 0.0;
  const double over = same_sign ? xd + t * r : (x - r) * (x + r);
  const double under = same_sign ? (d - r) * (d + r) : xd - t * r;
  const double tangent = over / under;
  const double half_chord = ((r - d) + near) * ((r + d) - near);
  const double crossing = (x + std::sqrt(half_chord < 0.0 ? 0.0 : half_chord)) * over_near;
  // The tangent point must lie in front of the camera and beyond the near plane: its depth is t / √(1 + slope²).
  const double in_front = x > 0.0 ? d - r : d + r;
  const double beyond = tt - near * near * (1.0 + tangent * tangent);
  const double touches = greater(beyond, d - r - near);
  const double usable = smaller(smaller(in_front, tt), touches >= 0.0 ? 1.0 : -1.0);
  return usable > 0.0 ? tangent : crossing;
}

struct Slopes {
  double min, max;
};

GLOAM_CPU_INLINE Slopes perspective_slopes(double x, double d, double r, double near) {
  const double over_near = 1.0 / near;
  const double tt = x * x + d * d - r * r;
  return {-greatest_slope(-x, d, r, near, over_near, tt), greatest_slope(x, d, r, near, over_near, tt)};
}

GLOAM_CPU_INLINE Slopes parallel_slopes(double x, double d, double r, double near) {
  const double half_chord = ((r - d) + near) * ((r + d) - near);
  const double reach = d >= near ? r : std::sqrt(half_chord < 0.0 ? 0.0 : half_chord);
  return {x - reach, x + reach};
}

/// First tile and end (one past the last tile) of the tiles that [low, high] touches, among `count` tiles that are
/// `size` long together. NaN gives all tiles; an interval that touches none gives begin = end.
struct Tiles {
  std::int32_t begin, end;
};
GLOAM_CPU_INLINE Tiles tiles_between(double low, double high, double count, double size, bool hidden) {
  const double last = count - 1.0;
  const double first_tile = greater(low - kMargin, 0.0);
  const double last_tile = smaller(high + kMargin, last);
  const bool outside = (low - kMargin > size) | (high + kMargin < 0.0) | hidden;
  const auto begin = static_cast<std::int32_t>(smaller(first_tile, last));
  const auto end = static_cast<std::int32_t>(greater(last_tile, 0.0)) + 1;
  return {outside ? 0 : begin, outside ? 0 : end};
}

/// Columns of TileOutlines as plain pointers, so that the compiler vectorizes loops over them.
struct Columns {
  explicit Columns(TileOutlines& o)
      : x(o.x.data()),
        y(o.y.data()),
        depth(o.depth.data()),
        radius(o.radius.data()),
        farthest(o.farthest.data()),
        column_begin(o.column_begin.data()),
        column_end(o.column_end.data()),
        row_begin(o.row_begin.data()),
        row_end(o.row_end.data()),
        middle(o.middle.data()),
        lean(o.lean.data()),
        half(o.half.data()),
        radius2(o.radius2.data()),
        row_slope(o.row_slope.data()),
        least_slope(o.least_slope.data()),
        greatest_slope(o.greatest_slope.data()),
        leftmost_row(o.leftmost_row.data()),
        rightmost_row(o.rightmost_row.data()) {}
  const double *x, *y, *depth, *radius, *farthest;
  std::int32_t *column_begin, *column_end, *row_begin, *row_end;
  float *middle, *lean, *half, *radius2, *row_slope, *least_slope, *greatest_slope;
  std::int32_t *leftmost_row, *rightmost_row;
};

template <bool kPerspective>
GLOAM_CPU_INLINE void find_rectangle(const Columns& o, const TileProjection& p, std::size_t i) {
  const double x = o.x[i], y = o.y[i], d = o.depth[i], r = o.radius[i];
  const Slopes across = kPerspective ? perspective_slopes(x, d, r, p.near_m) : parallel_slopes(x, d, r, p.near_m);
  const Slopes up = kPerspective ? perspective_slopes(y, d, r, p.near_m) : parallel_slopes(y, d, r, p.near_m);
  const bool hidden = o.farthest[i] < p.near_m;
  const double left = across.min * p.column_scale + p.column_offset;
  const double right = across.max * p.column_scale + p.column_offset;
  const double top = up.max * p.row_scale + p.row_offset;
  const double bottom = up.min * p.row_scale + p.row_offset;
  const Tiles columns = tiles_between(left, right, p.columns, p.width, hidden);
  const Tiles rows = tiles_between(top, bottom, p.rows, p.height, hidden);
  o.column_begin[i] = columns.begin;
  o.column_end[i] = columns.end;
  o.row_begin[i] = rows.begin;
  o.row_end[i] = rows.end;
}

GLOAM_CPU_CLONES void find_perspective_rectangles(Columns o, TileProjection p, std::size_t begin, std::size_t end) {
  GLOAM_CPU_IVDEP
  for (std::size_t i = begin; i < end; ++i) find_rectangle<true>(o, p, i);
}

GLOAM_CPU_CLONES void find_parallel_rectangles(Columns o, TileProjection p, std::size_t begin, std::size_t end) {
  GLOAM_CPU_IVDEP
  for (std::size_t i = begin; i < end; ++i) find_rectangle<false>(o, p, i);
}

/// Clamps columns, rows or slopes to ±kEverywhere, which fits a float and an integer. NaN gives one of the limits.
GLOAM_CPU_INLINE double tame(double v) { return smaller(greater(v, -kEverywhere), kEverywhere); }

/// The row of tiles as an integer; -1 above the image, p.rows below it.
GLOAM_CPU_INLINE std::int32_t row_number(double row, const TileProjection& p) {
  const double inside = row > p.height ? static_cast<double>(p.rows) : greater(row, -1.0);
  return static_cast<std::int32_t>(inside + 1.0) - 1;
}

GLOAM_CPU_CLONES void find_perspective_ellipses(Columns o, TileProjection p, std::size_t begin, std::size_t end) {
  GLOAM_CPU_IVDEP
  for (std::size_t i = begin; i < end; ++i) {
    const double x = o.x[i], y = o.y[i], d = o.depth[i], r = o.radius[i];
    const double dd = (d - r) * (d + r);
    const double along_rows = dd + x * x;  // squared length of the tangent in the plane of x and depth
    const double along_columns = dd + y * y;
    const double t = std::sqrt(greater(dd + x * x + y * y, 0.0));
    const double t_x = std::sqrt(greater(along_rows, 0.0)) * r;
    const double t_y = std::sqrt(greater(along_columns, 0.0)) * r;
    const double over_dd = 1.0 / dd;
    const double scale = p.column_scale / along_columns;
    const double turn =
        y / along_rows;  // row slope of the outline's extreme point with column slope u: (x · u + d) · turn
    const double left_row = (x * ((x * d - t_x) * over_dd) + d) * turn * p.row_scale + p.row_offset;
    const double right_row = (x * ((x * d + t_x) * over_dd) + d) * turn * p.row_scale + p.row_offset;
    const bool clear = (d - r >= p.near_m) & (d >= kClearance * r);
    o.middle[i] = static_cast<float>(clear ? tame(x * d * scale + p.column_offset) : 0.0);
    o.lean[i] = static_cast<float>(clear ? tame(x * y * scale) : 0.0);
    o.half[i] = static_cast<float>(clear ? tame(t * d * scale) : kEverywhere);
    o.radius2[i] = static_cast<float>(clear ? (r / d) * (r / d) : kEverywhere * kEverywhere);
    o.row_slope[i] = static_cast<float>(clear ? tame(y / d) : 0.0);
    o.least_slope[i] = static_cast<float>(clear ? tame((y * d - t_y) * over_dd) : -kEverywhere);
    o.greatest_slope[i] = static_cast<float>(clear ? tame((y * d + t_y) * over_dd) : kEverywhere);
    o.leftmost_row[i] = row_number(left_row, p);
    o.rightmost_row[i] = row_number(right_row, p);
  }
}

GLOAM_CPU_CLONES void find_parallel_ellipses(Columns o, TileProjection p, std::size_t begin, std::size_t end) {
  GLOAM_CPU_IVDEP
  for (std::size_t i = begin; i < end; ++i) {
    const double r = o.radius[i];
    const bool sound = (o.depth[i] >= p.near_m) & (r < kEverywhere);
    const double row = o.y[i] * p.row_scale + p.row_offset;
    o.middle[i] = static_cast<float>(sound ? tame(o.x[i] * p.column_scale + p.column_offset) : 0.0);
    o.lean[i] = 0.0f;
    o.half[i] = static_cast<float>(sound ? p.column_scale : kEverywhere);
    o.radius2[i] = static_cast<float>(sound ? r * r : kEverywhere * kEverywhere);
    o.row_slope[i] = static_cast<float>(sound ? tame(o.y[i]) : 0.0);
    o.least_slope[i] = static_cast<float>(sound ? tame(o.y[i] - r) : -kEverywhere);
    o.greatest_slope[i] = static_cast<float>(sound ? tame(o.y[i] + r) : kEverywhere);
    o.leftmost_row[i] = row_number(row, p);
    o.rightmost_row[i] = o.leftmost_row[i];
  }
}

/// Inputs and outputs of the cone lines.
struct LineColumns {
  explicit LineColumns(TileOutlines& o)
      : radius(o.radius.data()),
        apex_x(o.apex_x.data()),
        apex_y(o.apex_y.data()),
        apex_depth(o.apex_depth.data()),
        toward_x(o.toward_x.data()),
        toward_y(o.toward_y.data()),
        toward_depth(o.toward_depth.data()),
        sine(o.sine.data()),
        first(o.lines[0]),
        second(o.lines[1]) {}
  struct Line {
    explicit Line(TileOutlines::Line& line)
        : left_slope(line.left_slope.data()),
          left_bound(line.left_bound.data()),
          right_slope(line.right_slope.data()),
          right_bound(line.right_bound.data()) {}
    float *left_slope, *left_bound, *right_slope, *right_bound;
  };
  const double *radius, *apex_x, *apex_y, *apex_depth, *toward_x, *toward_y, *toward_depth, *sine;
  Line first, second;
};

/// Writes the line nx · u + ny · s + nd ≥ -opening (u: column slope, s: row slope) as a left or right bound. If the
/// line is not usable or nearly parallel to the rows, the bound is ±kEverywhere and clips nothing.
GLOAM_CPU_INLINE void put_line(const LineColumns::Line& line, std::size_t i, const TileProjection& p, bool usable,
                               double nx, double ny, double nd, double opening) {
  const double over_nx = p.column_scale / nx;
  const double slope = tame(-ny * over_nx);
  const double bound = tame(p.column_offset - (nd + opening) * over_nx);
  const bool left = usable & (nx > 1e-6);
  const bool right = usable & (nx < -1e-6);
  line.left_slope[i] = static_cast<float>(left ? slope : 0.0);
  line.left_bound[i] = static_cast<float>(left ? bound - kLineMargin : -kEverywhere);
  line.right_slope[i] = static_cast<float>(right ? slope : 0.0);
  line.right_bound[i] = static_cast<float>(right ? bound + kLineMargin : kEverywhere);
}

/// The two planes through the camera that contain the apex and touch the cone: unit normal N with N · P = 0 and N · D =
/// sin θ, where P is the direction to the apex (orthographic: the view direction) and D the cone's axis. Every point v
/// that the cone lights has N · v ≥ 0. There are no lines when the camera looks nearly along the axis.
template <bool kPerspective>
GLOAM_CPU_INLINE void find_lines_of(const LineColumns& o, const TileProjection& p, std::size_t i) {
  const double px = o.apex_x[i], py = o.apex_y[i], pd = o.apex_depth[i];
  const double over_length = 1.0 / std::sqrt(px * px + py * py + pd * pd);
  const double ax = kPerspective ? px * over_length : 0.0;
  const double ay = kPerspective ? py * over_length : 0.0;
  const double ad = kPerspective ? pd * over_length : 1.0;
  const double tx = o.toward_x[i], ty = o.toward_y[i], td = o.toward_depth[i];
  const double along = tx * ax + ty * ay + td * ad;
  const double bx = tx - along * ax, by = ty - along * ay, bd = td - along * ad;
  const double across = std::sqrt(bx * bx + by * by + bd * bd);
  const double cosine = o.sine[i] / across;
  const bool aside = (across > kLeastAcross) & (cosine < 1.0 - 1e-6);
  const double on_b = cosine / across;
  const double on_c = std::sqrt(greater(1.0 - cosine * cosine, 0.0)) / across;
  const double cx = ay * td - ad * ty, cy = ad * tx - ax * td, cd = ax * ty - ay * tx;
  const double opening = kLineRounding * (kPerspective ? p.greatest_ray : std::abs(px) + std::abs(py) + o.radius[i]);
  const double x1 = on_b * bx + on_c * cx, y1 = on_b * by + on_c * cy;
  const double x2 = on_b * bx - on_c * cx, y2 = on_b * by - on_c * cy;
  const double d1 = kPerspective ? on_b * bd + on_c * cd : -(x1 * px + y1 * py);
  const double d2 = kPerspective ? on_b * bd - on_c * cd : -(x2 * px + y2 * py);
  put_line(o.first, i, p, aside, x1, y1, d1, opening);
  put_line(o.second, i, p, aside, x2, y2, d2, opening);
}

GLOAM_CPU_CLONES void find_perspective_lines(LineColumns o, TileProjection p, std::size_t begin, std::size_t end) {
  GLOAM_CPU_IVDEP
  for (std::size_t i = begin; i < end; ++i) find_lines_of<true>(o, p, i);
}

GLOAM_CPU_CLONES void find_parallel_lines(LineColumns o, TileProjection p, std::size_t begin, std::size_t end) {
  GLOAM_CPU_IVDEP
  for (std::size_t i = begin; i < end; ++i) find_lines_of<false>(o, p, i);
}

/// View rotation in double: gives (x, y, depth) of a camera-relative vector.
struct Rotation {
  explicit Rotation(const mat4& view_from_relative) {
    for (int axis = 0; axis < 3; ++axis) {
      right[axis] = view_from_relative[axis][0];
      up[axis] = view_from_relative[axis][1];
      front[axis] = -static_cast<double>(view_from_relative[axis][2]);
    }
  }
  void turn(const vec3& v, double& x, double& y, double& depth) const {
    const double a = v.x, b = v.y, c = v.z;
    x = right[0] * a + right[1] * b + right[2] * c;
    y = up[0] * a + up[1] * b + up[2] * c;
    depth = front[0] * a + front[1] * b + front[2] * c;
  }
  double right[3], up[3], front[3];
};

/// Output columns of turn_bounds: bounds in view space.
struct BoundColumns {
  double *x, *y, *depth, *radius, *farthest;
};

/// Rotates bounds into view space. Lights are an array of structures and the loop needs columns: each block is gathered
/// first and then rotated with vector instructions.
GLOAM_CPU_CLONES void turn_bounds(const MaskLight* lights, BoundColumns o, Rotation rotation, std::size_t begin,
                                  std::size_t end) {
  constexpr std::size_t kBlock = 64;
  alignas(64) float from[8][kBlock] = {};
  for (std::size_t block = begin; block < end; block += kBlock) {
    const std::size_t count = end - block < kBlock ? end - block : kBlock;
    for (std::size_t i = 0; i < count; ++i) {
      const MaskLight& light = lights[block + i];
      from[0][i] = light.bounds.center.x;
      from[1][i] = light.bounds.center.y;
      from[2][i] = light.bounds.center.z;
      from[3][i] = light.bounds.radius;
      from[4][i] = light.apex.x;
      from[5][i] = light.apex.y;
      from[6][i] = light.apex.z;
      from[7][i] = light.cos_outer > -1.0f ? light.range_m : 1e30f;
    }
    GLOAM_CPU_IVDEP
    for (std::size_t i = 0; i < count; ++i) {
      const double a = from[0][i], b = from[1][i], c = from[2][i], given = from[3][i];
      const double x = rotation.right[0] * a + rotation.right[1] * b + rotation.right[2] * c;
      const double y = rotation.up[0] * a + rotation.up[1] * b + rotation.up[2] * c;
      const double depth = rotation.front[0] * a + rotation.front[1] * b + rotation.front[2] * c;
      const double rounding = kRounding * (std::abs(x) + std::abs(y) + std::abs(depth) + given);
      const double farthest = depth + given + rounding;
      // A spot also reaches no farther than its range from the apex. Its sphere may, if the spot shines toward the
      // camera.
      const double apex =
          rotation.front[0] * from[4][i] + rotation.front[1] * from[5][i] + rotation.front[2] * from[6][i];
      const double reach = apex + from[7][i] + rounding;
      o.x[block + i] = x;
      o.y[block + i] = y;
      o.depth[block + i] = depth;
      o.radius[block + i] = given + rounding;
      o.farthest[block + i] = reach < farthest ? reach : farthest;
    }
  }
}

void load_bounds(std::span<const MaskLight> lights, const Rotation& rotation, JobRange range, TileOutlines& o) {
  turn_bounds(lights.data(), {o.x.data(), o.y.data(), o.depth.data(), o.radius.data(), o.farthest.data()}, rotation,
              range.begin, range.end);
}

void load_cones(std::span<const MaskLight> lights, const Rotation& rotation, JobRange range, TileOutlines& o) {
  for (std::size_t i = range.begin; i < range.end; ++i) {
    rotation.turn(lights[i].apex, o.apex_x[i], o.apex_y[i], o.apex_depth[i]);
    rotation.turn(lights[i].direction, o.toward_x[i], o.toward_y[i], o.toward_depth[i]);
    const double cosine = static_cast<double>(lights[i].cos_outer) - kCosineRounding;
    o.sine[i] = cosine > 0.0 ? std::sqrt(1.0 - cosine * cosine) : 2.0;  // 2: the cone gets no lines
  }
}

}  // namespace

TileProjection tile_projection(const ViewProjection& view) {
  const mat4& clip = view.clip_from_view;
  TileProjection p;
  p.perspective = clip[2][3] != 0.0f;
  p.near_m = view.near_m;
  p.columns = (view.width + GLOAM_LIGHT_TILE - 1) / GLOAM_LIGHT_TILE;
  p.rows = (view.height + GLOAM_LIGHT_TILE - 1) / GLOAM_LIGHT_TILE;
  const double across = 0.5 * kTilesAPixel * view.width;
  const double down = 0.5 * kTilesAPixel * view.height;
  const double shift_x = p.perspective ? -static_cast<double>(clip[2][0]) : static_cast<double>(clip[3][0]);
  const double shift_y = p.perspective ? -static_cast<double>(clip[2][1]) : static_cast<double>(clip[3][1]);
  p.width = kTilesAPixel * view.width;
  p.height = kTilesAPixel * view.height;
  p.column_scale = clip[0][0] * across;
  p.column_offset = (1.0 + shift_x) * across;
  p.row_scale = -clip[1][1] * down;
  p.row_offset = (1.0 - shift_y) * down;
  const double widest = (1.0 + std::abs(shift_x)) / static_cast<double>(clip[0][0]);
  const double highest = (1.0 + std::abs(shift_y)) / static_cast<double>(clip[1][1]);
  p.greatest_ray = std::sqrt(1.0 + widest * widest + highest * highest);
  return p;
}

void TileOutlines::resize(std::size_t count) {
  for (auto* column :
       {&x, &y, &depth, &radius, &farthest, &apex_x, &apex_y, &apex_depth, &toward_x, &toward_y, &toward_depth, &sine})
    column->resize(count);
  for (auto* column : {&column_begin, &column_end, &row_begin, &row_end, &leftmost_row, &rightmost_row})
    column->resize(count);
  for (auto* column : {&middle, &lean, &half, &radius2, &row_slope, &least_slope, &greatest_slope})
    column->resize(count);
  for (Line& line : lines)
    for (auto* column : {&line.left_slope, &line.left_bound, &line.right_slope, &line.right_bound})
      column->resize(count);
}

void find_outlines(std::span<const MaskLight> lights, const ViewProjection& view, const TileProjection& projection,
                   OutlineDetail detail, JobRange range, TileOutlines& outlines) {
  const Rotation rotation(view.view_from_relative);
  load_bounds(lights, rotation, range, outlines);
  const Columns columns(outlines);
  (projection.perspective ? find_perspective_rectangles : find_parallel_rectangles)(columns, projection, range.begin,
                                                                                    range.end);
  if (detail == OutlineDetail::rectangles) return;
  (projection.perspective ? find_perspective_ellipses : find_parallel_ellipses)(columns, projection, range.begin,
                                                                                range.end);
  if (detail == OutlineDetail::ellipses) return;
  load_cones(lights, rotation, range, outlines);
  (projection.perspective ? find_perspective_lines : find_parallel_lines)(LineColumns(outlines), projection,
                                                                          range.begin, range.end);
}

}  // namespace gloam
