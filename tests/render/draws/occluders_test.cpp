// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/draws/occluders.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/render_scene.h"

namespace gloam {
namespace {

/// Draws of one cluster each, in front of a camera that looks along −Z.
class Occluders : public ::testing::Test {
 protected:
  /// A square of 2 · half metres that faces the camera.
  Draw& add(float distance_m, float half, std::uint32_t triangles, std::uint32_t features = 0) {
    const vec3 middle(0.0f, 0.0f, -distance_m);
    Draw draw;
    draw.entity.index = static_cast<std::uint32_t>(draws_.solid.size());
    draw.variant.features = features;
    draw.bounds = {middle - vec3(half, half, 0.0f), middle + vec3(half, half, 0.0f)};
    draw.first_index = 1000 * draw.entity.index;
    draw.index_count = 3 * triangles;
    draw.first_cluster = static_cast<std::uint32_t>(draws_.clusters.size());
    draw.cluster_count = 1;
    draws_.clusters.push_back({draw.bounds.min, draw.first_index, draw.bounds.max, draw.index_count});
    return draws_.solid.emplace_back(draw);
  }
  [[nodiscard]] std::vector<std::uint32_t> chosen(std::uint32_t most_triangles) const {
    std::vector<std::uint32_t> indices;
    for (const Draw& draw : choose_occluders(view_, draws_, most_triangles)) indices.push_back(draw.entity.index);
    return indices;
  }

  ViewDraws draws_;
  RenderView view_ = make_view(test::look_at(dvec3(0.0), dvec3(0.0, 0.0, -1.0), 64, 64), 0);
};

using Indices = std::vector<std::uint32_t>;

TEST_F(Occluders, near_and_simple_surfaces_come_first) {
  add(20.0f, 1.0f, 2);
  add(5.0f, 1.0f, 2);
  add(5.0f, 1.0f, 200);
  EXPECT_EQ(chosen(2), Indices{1});
  EXPECT_EQ(chosen(4), (Indices{0, 1}));
  EXPECT_EQ(chosen(203), (Indices{0, 1})) << "never more triangles than asked for";
  EXPECT_EQ(chosen(204), (Indices{0, 1, 2}));
  EXPECT_EQ(chosen(0), Indices{});
  EXPECT_EQ(solid_triangles(draws_), 204u);
}

TEST_F(Occluders, surfaces_with_holes_or_without_known_bounds_are_none) {
  add(5.0f, 1.0f, 2, GLOAM_SURFACE_MASK);
  add(5.0f, 1.0f, 2).bounds = {};
  add(5.0f, 1.0f, 2, GLOAM_SURFACE_DOUBLE_SIDED | GLOAM_SURFACE_NORMAL_TEXTURE);
  EXPECT_EQ(chosen(100), Indices{2});
  EXPECT_EQ(choose_occluders(view_, draws_, 100)[0].variant.features, 0u) << "one pipeline draws all materials";
}

TEST_F(Occluders, neighbours_of_a_draw_are_drawn_together_and_others_apart) {
  Draw& first = add(5.0f, 1.0f, 2);
  for (std::uint32_t i = 1; i < 4; ++i) {
    draws_.clusters.push_back(draws_.clusters.front());
    draws_.clusters.back().first_index = 6 * i;
  }
  draws_.clusters[2].low = draws_.clusters[2].high = vec3(0.0f, 0.0f, -500.0f);  // too small to hide anything
  first.cluster_count = 4;
  first.index_count = 24;
  const std::vector<Draw> draws = choose_occluders(view_, draws_, 100);
  ASSERT_EQ(draws.size(), 2u);
  EXPECT_EQ(draws[0].first_index, 0u);
  EXPECT_EQ(draws[0].index_count, 12u);
  EXPECT_EQ(draws[1].first_index, 18u);
  EXPECT_EQ(draws[1].index_count, 6u);
}

}  // namespace
}  // namespace gloam
