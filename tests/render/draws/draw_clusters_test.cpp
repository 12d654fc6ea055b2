// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/render/draws/draw_lists_fixture.h"

namespace gloam {
namespace {

using test::DrawListsTest;
using test::drawn_order;
using test::grid;
using test::placed;

TEST_F(DrawListsTest, a_mesh_seen_whole_is_one_draw_and_a_close_look_draws_few_clusters) {
  const std::uint32_t mesh = maker_.mesh(grid(64));
  sync();
  draw(mesh, placed(dvec3(-32.0, 0.0, -32.0), dvec3(0, 1, 0), 0.0, dvec3(1.0)));
  const FrameDraws whole = lists_of(make_view(test::look_at(dvec3(0.0, 200.0, 1.0), dvec3(0.0), 64, 64), 0));
  ASSERT_EQ(whole.views[0].solid.size(), 1u);
  EXPECT_EQ(whole.views[0].solid[0].index_count, 64u * 64u * 6u);
  const FrameDraws close = lists_of(make_view(test::look_at(dvec3(3.0, 2.0, 3.0), dvec3(3.0, 0.0, 3.1), 64, 64), 0));
  std::uint32_t drawn = 0;
  for (const Draw& d : close.views[0].solid) drawn += d.index_count;
  EXPECT_GT(drawn, 0u);
  EXPECT_LT(drawn, 64u * 64u * 6u / 4u);
  EXPECT_EQ(close.views[0].culled_instances, 0u);
}

TEST_F(DrawListsTest, the_clusters_of_a_draw_are_its_triangles_in_order_and_their_boxes_hold_them) {
  const Primitive source = grid(64);
  const std::uint32_t mesh = maker_.mesh(source);
  sync();
  const std::vector<std::uint32_t> order = drawn_order(source);
  const dmat4 matrix = placed(dvec3(-32.0, 4000.0, 32.0), dvec3(0, 1, 0), 0.1, dvec3(1.0, 3.0, -1.0));
  draw(mesh, matrix);
  const dvec3 at(3.0, 4030.0, 3.0);
  const FrameDraws lists = lists_of(make_view(test::look_at(at, at - dvec3(1.0, 9.0, 2.0), 64, 64), 0));
  const ViewDraws& view = lists.views[0];
  ASSERT_FALSE(view.solid.empty());
  EXPECT_GT(view.clusters.size(), view.solid.size());
  std::size_t items = 0;
  for (const Draw& d : view.solid) {
    std::uint32_t next = d.first_index;
    for (std::uint32_t c = d.first_cluster; c < d.first_cluster + d.cluster_count; ++c) {
      const shaders::DrawCluster& cluster = view.clusters[c];
      ASSERT_EQ(cluster.first_index, next);
      next += cluster.index_count;
      for (std::uint32_t i = 0; i < cluster.index_count; ++i) {
        const vec3 position = source.positions[order[cluster.first_index - d.primitive->first_index + i]];
        const vec3 relative(dvec3(matrix * dvec4(position, 1.0)) - at);
        ASSERT_TRUE(glm::all(glm::greaterThanEqual(relative, cluster.low - 1e-3f)));
        ASSERT_TRUE(glm::all(glm::lessThanEqual(relative, cluster.high + 1e-3f)));
      }
    }
    ASSERT_EQ(next, d.first_index + d.index_count);
    items += d.cluster_count;
  }
  EXPECT_EQ(items, view.clusters.size()) << "no cluster belongs to two draws, or to none";
}

}  // namespace
}  // namespace gloam
