// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "engine/math/screen_bounds.h"
#include "modules/lights/masks/tile_light_masks.h"
#include "modules/lights/masks/tile_outlines.h"
#include "tests/math/generators.h"
#include "tests/modules/lights/masks/mask_oracle.h"
#include "tests/support/property.h"

namespace gloam {
namespace {

struct Edges {
  double low, high;
};

/// The tiles that [low, high] in normalised device coordinates touches, if it is narrowed or widened by an eighth of a
/// pixel.
struct Bracket {
  std::int32_t inner_begin, inner_end, outer_begin, outer_end;
};
Bracket bracket(Edges ndc, std::uint32_t pixels, std::int32_t tiles) {
  const auto tile = [&](double v, double off) {
    const double at = std::floor(((0.5 + 0.5 * v) * pixels + off) / GLOAM_LIGHT_TILE);
    return static_cast<std::int32_t>(std::clamp(at, 0.0, tiles - 1.0));
  };
  return {tile(ndc.low, 0.125), tile(ndc.high, -0.125) + 1, tile(ndc.low, -0.125), tile(ndc.high, 0.125) + 1};
}

/// Compares with the careful rectangle of a single sphere, which has its own oracle.
TEST(TileOutlinesProperties, rectangles_are_those_of_the_screen_bounds_of_random_spheres) {
  test::check_property(10000, [] {
    const auto seed = static_cast<std::uint32_t>(test::draw_index(1 << 30));
    RC_LOG() << "seed " << seed << '\n';
    test::SceneRandom random(seed);
    RenderView view = test::draw_view(random);
    while (view.camera.orthographic || view.clip_from_view[2][0] != 0.0f) view = test::draw_view(random);
    const MaskLight light = test::point_mask_light(
        test::relative_of_view(view, random.direction() * random.length(-1.0, 2.0)), random.length(-2.0, 1.5));
    TileOutlines outlines;
    outlines.resize(1);
    const TileProjection p = tile_projection(view);
    find_outlines(std::span(&light, 1), view, p, OutlineDetail::rectangles, {0, 1, 0}, outlines);
    const PerspectiveScale scale{vec2(view.clip_from_view[0][0], view.clip_from_view[1][1]), view.near_m};
    // Widened like the outlines, so that both describe the same sphere.
    const vec3 center(static_cast<float>(outlines.x[0]), static_cast<float>(outlines.y[0]),
                      static_cast<float>(-outlines.depth[0]));
    const NdcRect rect = screen_bounds(Sphere{center, static_cast<float>(outlines.radius[0])}, scale);
    const bool empty =
        outlines.column_begin[0] == outlines.column_end[0] || outlines.row_begin[0] == outlines.row_end[0];
    if (rect.empty) return;  // the two round differently where a sphere only just touches the screen
    const Bracket x = bracket({rect.min.x, rect.max.x}, view.width, static_cast<std::int32_t>(p.columns));
    const Bracket y = bracket({-rect.max.y, -rect.min.y}, view.height, static_cast<std::int32_t>(p.rows));
    const bool sliver = rect.max.x <= -1.0f + 1e-5f || rect.min.x >= 1.0f - 1e-5f || rect.max.y <= -1.0f + 1e-5f ||
                        rect.min.y >= 1.0f - 1e-5f ||
                        outlines.depth[0] + outlines.radius[0] < static_cast<double>(view.near_m) * 1.001;
    if (sliver) return;
    RC_ASSERT(!empty);
    RC_ASSERT(outlines.column_begin[0] <= std::max(x.inner_begin, 0));
    RC_ASSERT(outlines.column_end[0] >= x.inner_end);
    RC_ASSERT(outlines.row_begin[0] <= y.inner_begin);
    RC_ASSERT(outlines.row_end[0] >= y.inner_end);
    RC_ASSERT(outlines.column_begin[0] >= x.outer_begin);
    RC_ASSERT(outlines.column_end[0] <= x.outer_end);
    RC_ASSERT(outlines.row_begin[0] >= y.outer_begin);
    RC_ASSERT(outlines.row_end[0] <= y.outer_end);
  });
}

}  // namespace
}  // namespace gloam
