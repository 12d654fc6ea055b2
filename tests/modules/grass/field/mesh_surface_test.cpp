// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/field/mesh_surface.h"
#include "modules/grass/growth/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <numbers>

#include "tests/modules/grass/growth/lawns.h"

namespace gloam {
namespace {

const float kNotANumber = std::numeric_limits<float>::quiet_NaN();

/// A triangle of 0.5 m² that faces up.
Mesh one_triangle() { return test::mesh_of({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, {0, 1, 2}); }

dmat4 rotation(double degrees, dvec3 axis) { return glm::rotate(dmat4(1.0), degrees * std::numbers::pi / 180.0, axis); }

TEST(GrowthSurface, the_upward_facing_triangles_of_a_hilly_lawn_are_those_that_a_plain_loop_finds) {
  const Mesh mesh = test::lawn(40, 10.0f, [](float x, float z) { return 2.0f * std::sin(2.0f * x) * std::cos(z); });
  const dmat4 transform = glm::translate(dmat4(1.0), dvec3(5.0, -2.0, 3.0)) * rotation(20.0, dvec3(0.6, 0.0, 0.8)) *
                          glm::scale(dmat4(1.0), dvec3(1.0, 2.0, 0.5));
  const GrowthSurface surface = growth_surface(mesh, transform);
  const Primitive& primitive = mesh.primitives[0];
  std::size_t next = 0;
  double area = 0.0;
  for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
    std::array<dvec3, 3> corners;
    for (std::size_t c = 0; c < 3; ++c)
      corners[c] = dvec3(transform * dvec4(dvec3(primitive.positions[primitive.indices[i + c]]), 1.0));
    const dvec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (cross.y / glm::length(cross) < kGrowthCosine) continue;
    ASSERT_LT(next, surface.triangles.size());
    const GrowthTriangle& triangle = surface.triangles[next++];
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_LT(glm::length(surface.origin + triangle.corners[c] - corners[c]), 1e-12);
    EXPECT_LT(glm::length(dvec3(triangle.normal) - cross / glm::length(cross)), 1e-6);
    area += 0.5 * glm::length(cross);
  }
  EXPECT_EQ(next, surface.triangles.size());
  EXPECT_LT(next, primitive.indices.size() / 3);
  EXPECT_NEAR(surface.area_m2, area, 1e-9 * area);
}

TEST(GrowthSurface, neighbors_share_their_edge_and_name_each_other) {
  const GrowthSurface surface = growth_surface(
      test::lawn(20, 10.0f, [](float x, float z) { return 2.0f * std::sin(2.0f * x) * std::cos(z); }), dmat4(1.0));
  std::size_t inner = 0;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const GrowthTriangle& triangle = surface.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) {
      if (triangle.neighbors[i] == kNone) continue;
      ++inner;
      const GrowthTriangle& other = surface.triangles[triangle.neighbors[i]];
      const std::size_t edge = triangle.neighbor_edges[i];
      EXPECT_EQ(other.neighbors[edge], t);
      EXPECT_EQ(other.neighbor_edges[edge], i);
      EXPECT_EQ(other.corners[edge], triangle.corners[(i + 1) % 3]);
      EXPECT_EQ(other.corners[(edge + 1) % 3], triangle.corners[i]);
    }
  }
  EXPECT_GT(inner, surface.triangles.size());
}

// Hard case: grass.no_upward
TEST(GrowthSurface, a_mesh_without_upward_triangle_is_an_empty_surface) {
  const Mesh ceiling = test::mesh_of({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, {0, 2, 1});
  const Mesh wall = test::mesh_of({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}, {0, 1, 2});
  for (const Mesh& mesh : {ceiling, wall, Mesh{}, test::mesh_of({}, {})}) {
    const GrowthSurface surface = growth_surface(mesh, dmat4(1.0));
    EXPECT_TRUE(surface.triangles.empty());
    EXPECT_EQ(surface.area_m2, 0.0);
    EXPECT_EQ(surface.degenerate_faces + surface.refused_faces + surface.non_finite_faces, 0u);
  }
}

TEST(GrowthSurface, a_wall_that_is_turned_into_a_floor_grows_and_a_floor_turned_into_a_wall_does_not) {
  const Mesh wall = test::mesh_of({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}, {0, 2, 1});  // faces +Z
  EXPECT_TRUE(growth_surface(wall, dmat4(1.0)).triangles.empty());
  const GrowthSurface floor = growth_surface(wall, rotation(-90.0, dvec3(1.0, 0.0, 0.0)));
  ASSERT_EQ(floor.triangles.size(), 1u);
  EXPECT_NEAR(floor.triangles[0].normal.y, 1.0f, 1e-6f);
  EXPECT_TRUE(growth_surface(one_triangle(), rotation(90.0, dvec3(1.0, 0.0, 0.0))).triangles.empty());
}

TEST(GrowthSurface, slopes_grow_up_to_the_stated_cosine) {
  const double limit = std::acos(double{kGrowthCosine}) * 180.0 / std::numbers::pi;
  EXPECT_EQ(growth_surface(one_triangle(), rotation(limit - 0.01, dvec3(1.0, 0.0, 0.0))).triangles.size(), 1u);
  EXPECT_EQ(growth_surface(one_triangle(), rotation(limit + 0.01, dvec3(1.0, 0.0, 0.0))).triangles.size(), 0u);
}

TEST(GrowthSurface, a_mirrored_transform_keeps_the_upper_side_up) {
  for (const dvec3 scale : {dvec3(-1.0, 1.0, 1.0), dvec3(1.0, 1.0, -2.0), dvec3(-1.0, -1.0, -1.0)}) {
    const GrowthSurface surface = growth_surface(one_triangle(), glm::scale(dmat4(1.0), scale));
    ASSERT_EQ(surface.triangles.size(), scale.y > 0.0 ? 1u : 0u);
    for (const GrowthTriangle& triangle : surface.triangles) EXPECT_EQ(triangle.normal, vec3(0.0f, 1.0f, 0.0f));
  }
}

// Hard case: grass.no_area
TEST(GrowthSurface, faces_without_area_and_faces_that_are_not_finite_are_counted_and_left_out) {
  Mesh mesh = one_triangle();
  Primitive& primitive = mesh.primitives[0];
  primitive.positions.insert(
      primitive.positions.end(),
      {{2, 0, 0}, {3, 0, 0}, {kNotANumber, 0, 0}, {0, std::numeric_limits<float>::infinity(), 0}});
  primitive.indices.insert(primitive.indices.end(), {0, 2, 3, 0, 0, 1, 2, 3, 4, 0, 1, 5, 0, 1, 6, 5, 5, 5});
  const GrowthSurface surface = growth_surface(mesh, dmat4(1.0));
  EXPECT_EQ(surface.triangles.size(), 1u);
  EXPECT_EQ(surface.degenerate_faces, 3u);
  EXPECT_EQ(surface.non_finite_faces, 3u);
  EXPECT_EQ(surface.area_m2, 0.5);
}

// Hard case: grass.non_manifold
TEST(GrowthSurface, a_third_face_on_an_edge_is_refused_and_counted) {
  const Mesh mesh =
      test::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, 0, 1}, {0.5f, 0.5f, 1}}, {0, 1, 2, 0, 3, 1, 0, 4, 1});
  const GrowthSurface surface = growth_surface(mesh, dmat4(1.0));
  EXPECT_EQ(surface.triangles.size(), 2u);
  EXPECT_EQ(surface.refused_faces, 1u);
}

TEST(GrowthSurface, scale_0_or_a_matrix_that_is_not_finite_leaves_nothing) {
  const Mesh mesh = test::lawn(2, 1.0f);
  for (const dvec3 scale : {dvec3(0.0), dvec3(0.0, 1.0, 1.0), dvec3(1.0, 1.0, 0.0)}) {
    const GrowthSurface surface = growth_surface(mesh, glm::scale(dmat4(1.0), scale));
    EXPECT_TRUE(surface.triangles.empty());
    EXPECT_EQ(surface.degenerate_faces, 8u);
  }
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const GrowthSurface surface = growth_surface(mesh, glm::scale(dmat4(1.0), dvec3(bad, 1.0, 1.0)));
    EXPECT_TRUE(surface.triangles.empty());
    EXPECT_EQ(surface.non_finite_faces, 8u);
  }
  EXPECT_EQ(growth_surface(mesh, glm::scale(dmat4(1.0), dvec3(1.0, 0.0, 1.0))).triangles.size(), 8u);
}

TEST(GrowthSurface, every_primitive_takes_part) {
  Mesh mesh = test::lawn(2, 1.0f);
  mesh.primitives.push_back(test::lawn(3, 2.0f).primitives[0]);
  mesh.primitives.emplace_back();
  const GrowthSurface surface = growth_surface(mesh, dmat4(1.0));
  EXPECT_EQ(surface.triangles.size(), 8u + 18u);
  EXPECT_NEAR(surface.area_m2, 5.0, 1e-6);
  for (std::uint32_t t = 0; t < 26; ++t)
    for (const std::uint32_t n : surface.triangles[t].neighbors) EXPECT_TRUE(n == kNone || (n < 8) == (t < 8));
}

TEST(GrowthSurface, morph_targets_have_no_effect) {
  Mesh mesh = one_triangle();
  mesh.primitives[0].morph_targets.push_back({{{0, 5, 0}, {0, 5, 0}, {0, 0, 0}}, {}});
  mesh.morph_weights = {1.0f};
  EXPECT_EQ(growth_surface(mesh, dmat4(1.0)).area_m2, 0.5);
}

TEST(GrowthSurface, a_translation_changes_only_the_origin) {
  const Mesh mesh = test::lawn(10, 10.0f, &test::hills);
  const dmat4 turned = rotation(10.0, dvec3(1.0, 0.0, 0.0));
  const dvec3 far(100000.3, -20000.7, 1e9);
  const GrowthSurface near = growth_surface(mesh, turned);
  const GrowthSurface moved = growth_surface(mesh, glm::translate(dmat4(1.0), far) * turned);
  EXPECT_EQ(moved.origin, far);
  ASSERT_EQ(moved.triangles.size(), near.triangles.size());
  for (std::size_t i = 0; i < near.triangles.size(); ++i)
    EXPECT_EQ(moved.triangles[i].corners, near.triangles[i].corners);
}

}  // namespace
}  // namespace gloam
