// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/assets/topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/scene/assets/topology_oracle.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

const std::vector<vec3> kSquare{vec3(0, 0, 0), vec3(1, 0, 0), vec3(1, 1, 0), vec3(0, 1, 0)};

TEST(Topology, two_triangles_of_a_square_are_neighbours_over_the_diagonal) {
  const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
  const Topology topology = build_topology(kSquare, indices);
  ASSERT_EQ(topology.faces.size(), 2u);
  EXPECT_EQ(topology.neighbors[0], (std::array{~0u, ~0u, 1u}));
  EXPECT_EQ(topology.neighbors[1], (std::array{0u, ~0u, ~0u}));
  EXPECT_EQ(topology.face_normals[0], vec3(0, 0, 1));
  EXPECT_EQ(topology.refused_faces + topology.degenerate_faces, 0u);
  test::expect_as_brute_force(kSquare, indices);
}

TEST(Topology, a_closed_tetrahedron_has_no_border) {
  const std::vector<vec3> positions{vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)};
  const std::vector<std::uint32_t> indices{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  const Topology topology = build_topology(positions, indices);
  ASSERT_EQ(topology.faces.size(), 4u);
  for (const auto& across : topology.neighbors) {
    for (const std::uint32_t face : across) EXPECT_NE(face, ~0u);
  }
  test::expect_as_brute_force(positions, indices);
}

TEST(Topology, the_third_face_on_an_edge_is_refused_and_counted) {
  const std::vector<vec3> positions{vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0), vec3(0, 0, 1)};
  const std::vector<std::uint32_t> indices{0, 1, 2, 1, 0, 3, 0, 1, 4};
  const Topology topology = build_topology(positions, indices);
  EXPECT_EQ(topology.faces.size(), 2u);
  EXPECT_EQ(topology.refused_faces, 1u);
  EXPECT_EQ(topology.source_faces, (std::vector<std::uint32_t>{0, 1}));
  test::expect_as_brute_force(positions, indices);
}

TEST(Topology, a_face_on_a_vertex_that_is_closed_all_around_is_refused) {
  // Four faces close around vertex 4; a fifth touches it with one corner.
  std::vector<vec3> positions = kSquare;
  positions.insert(positions.end(), {vec3(0.5f, 0.5f, 0), vec3(0, 0, 2), vec3(1, 0, 2)});
  const std::vector<std::uint32_t> indices{0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 4, 5, 6};
  const Topology topology = build_topology(positions, indices);
  EXPECT_EQ(topology.faces.size(), 4u);
  EXPECT_EQ(topology.refused_faces, 1u);
  test::expect_as_brute_force(positions, indices);
}

TEST(Topology, a_face_that_closes_one_of_two_fans_is_refused) {
  // Two fans meet at vertex 4; the last face would close the first of them.
  std::vector<vec3> positions = kSquare;
  positions.insert(positions.end(), {vec3(0.5f, 0.5f, 0), vec3(0, 0, 2), vec3(1, 0, 2)});
  const std::vector<std::uint32_t> indices{0, 1, 4, 1, 2, 4, 2, 3, 4, 4, 5, 6, 3, 0, 4};
  testing::internal::CaptureStderr();
  const Topology topology = build_topology(positions, indices);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");  // counted, not printed
  EXPECT_EQ(topology.source_faces, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(topology.refused_faces, 1u);
  test::expect_as_brute_force(positions, indices);
}

TEST(Topology, a_face_of_the_other_winding_on_a_taken_side_is_refused) {
  const std::vector<std::uint32_t> indices{0, 1, 2, 2, 0, 3, 0, 1, 3};
  test::expect_as_brute_force(kSquare, indices);
}

TEST(Topology, faces_without_area_are_degenerate) {
  const std::vector<vec3> positions{vec3(0, 0, 0), vec3(1, 1, 1), vec3(3, 3, 3), vec3(0, 1, 0)};
  const std::vector<std::uint32_t> indices{0, 0, 1, 0, 1, 2, 1, 1, 1, 0, 1, 3};
  const Topology topology = build_topology(positions, indices);
  EXPECT_EQ(topology.degenerate_faces, 3u);
  EXPECT_EQ(topology.source_faces, (std::vector<std::uint32_t>{3}));
}

TEST(Topology, tiny_and_huge_triangles_are_kept_with_unit_normals) {
  for (const float size : {1e-40f, 1e-20f, 1e20f, 1e38f}) {
    const std::vector<vec3> positions{vec3(0), vec3(size, 0, 0), vec3(0, size, 0)};
    const Topology topology = build_topology(positions, std::vector<std::uint32_t>{0, 1, 2});
    ASSERT_EQ(topology.faces.size(), 1u) << size;
    EXPECT_EQ(topology.face_normals[0], vec3(0, 0, 1)) << size;
  }
}

TEST(Topology, positions_that_are_not_finite_make_degenerate_faces) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<vec3> positions{vec3(0), vec3(1, 0, 0), vec3(nan, 0, 0), vec3(0, infinity, 0)};
  EXPECT_EQ(build_topology(positions, std::vector<std::uint32_t>{0, 1, 2, 0, 1, 3}).degenerate_faces, 2u);
}

TEST(Topology, minus_zero_welds_with_zero) {
  const std::vector<vec3> positions{vec3(0.0f, 0, 0),      vec3(1, 0, 0),     vec3(1, 1, 0),
                                    vec3(-0.0f, -0.0f, 0), vec3(1, 1, -0.0f), vec3(0, 1, 0)};
  const std::vector<std::uint32_t> indices{0, 1, 2, 3, 4, 5};
  const Topology topology = build_topology(positions, indices);
  EXPECT_EQ(topology.positions.size(), 4u);
  EXPECT_EQ(topology.neighbors[0][2], 1u);
  for (const vec3& p : topology.positions) EXPECT_FALSE(std::signbit(p.x) || std::signbit(p.y) || std::signbit(p.z));
  test::expect_as_brute_force(positions, indices);
}

TEST(Topology, a_seam_of_doubled_vertices_is_welded) {
  // A strip whose second half has its own copies of the shared column, as textures with seams do.
  const std::vector<vec3> positions{vec3(0, 0, 0), vec3(1, 0, 0), vec3(1, 1, 0), vec3(0, 1, 0),
                                    vec3(1, 0, 0), vec3(2, 0, 0), vec3(2, 1, 0), vec3(1, 1, 0)};
  const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
  const Topology topology = build_topology(positions, indices);
  EXPECT_EQ(topology.positions.size(), 6u);
  EXPECT_EQ(topology.neighbors[0][1], 3u);
  test::expect_as_brute_force(positions, indices);
}

TEST(Topology, nothing_gives_nothing) {
  const Topology topology = build_topology({}, {});
  EXPECT_TRUE(topology.faces.empty());
  EXPECT_TRUE(topology.neighbors.empty());
}

TEST(Topology, misuse_asserts) {
  EXPECT_ASSERT((void)build_topology(kSquare, std::vector<std::uint32_t>{0, 1}), "three indices");
  EXPECT_ASSERT((void)build_topology(kSquare, std::vector<std::uint32_t>{0, 1, 4}), "names a position");
}

}  // namespace
}  // namespace gloam
