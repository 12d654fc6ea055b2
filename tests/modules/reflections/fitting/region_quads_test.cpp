// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/fitting/region_quads.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/modules/reflections/fitting/fit_scene.h"

namespace gloam {
namespace {

using Meshes = std::vector<FitTriangles>;

std::vector<FittedQuad> fit(const Meshes& meshes, const QuadSettings& settings = {}) {
  return fit_quads(meshes, RegionTolerance(), settings, *make_serial_executor());
}

double width(const FittedQuad& fitted) { return 2.0 * glm::length(fitted.quad.half_u); }
double height(const FittedQuad& fitted) { return 2.0 * glm::length(fitted.quad.half_v); }

void expect_rectangle(const FittedQuad& fitted) {
  const PlacedProxy& q = fitted.quad;
  EXPECT_NEAR(glm::dot(glm::normalize(q.half_u), glm::normalize(q.half_v)), 0.0, 1e-9);
  EXPECT_LT(glm::length(glm::normalize(glm::cross(q.half_u, q.half_v)) - q.normal), 1e-9);
}

/// Both halves of an L of 8 m × 8 m whose arms are 2 m wide.
Meshes l_shape() { return {test::wall(0.0, 0.0, 8.0, 2.0), test::wall(0.0, 2.0, 2.0, 6.0)}; }

TEST(FittedQuads, of_a_room_are_its_walls_and_its_ceiling) {
  const std::vector<FittedQuad> quads = fit({test::box(dvec3(0.0), dvec3(4.0, 3.0, 5.0), true)});
  ASSERT_EQ(quads.size(), 5u);
  const dvec3 center(2.0, 1.5, 2.5);
  double area = 0.0;
  for (const FittedQuad& fitted : quads) {
    expect_rectangle(fitted);
    EXPECT_GT(glm::dot(fitted.quad.normal, center - fitted.quad.center), 0.0) << "faces inward";
    EXPECT_LT(fitted.quad.normal.y, 0.5);
    EXPECT_GT(fitted.coverage(), 0.95);
    area += width(fitted) * height(fitted);
  }
  EXPECT_NEAR(area, 2.0 * (12.0 + 15.0) + 20.0, 2.0);
}

TEST(FittedQuads, have_the_outline_of_a_wall_to_the_cell) {
  const std::vector<FittedQuad> quads = fit({test::wall(-3.0, 0.5, 7.3, 2.9, -2.0)});
  ASSERT_EQ(quads.size(), 1u);
  const double cell = QuadSettings().cell_m;
  EXPECT_NEAR(width(quads[0]), 7.3, cell);
  EXPECT_NEAR(height(quads[0]), 2.9, cell);
  EXPECT_LT(glm::length(quads[0].quad.center - dvec3(0.65, 1.95, -2.0)), cell);
  EXPECT_NEAR(quads[0].covered_m2, 7.3 * 2.9, 0.6);
  EXPECT_NEAR(std::abs(quads[0].quad.half_u.y), 0.0, 1e-12) << "u is horizontal";
}

TEST(FittedQuads, join_the_bricks_of_a_wall) {
  Meshes bricks;
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 12; ++column) {
      const dvec3 at(0.27 * column + (row % 2 == 0 ? 0.0 : 0.13), 0.12 * row, row % 3 == 0 ? 0.02 : 0.0);
      bricks.push_back(test::box(at, at + dvec3(0.25, 0.1, 0.1)));
    }
  QuadSettings settings;
  settings.min_area_m2 = 2.0;  // more than the bricks' ends
  const std::vector<FittedQuad> quads = fit(bricks, settings);
  ASSERT_EQ(quads.size(), 2u) << "front and back";
  for (const FittedQuad& fitted : quads) {
    EXPECT_NEAR(width(fitted), 0.27 * 12 + 0.13, 0.3);
    EXPECT_NEAR(height(fitted), 2.4, 0.3);
    EXPECT_NEAR(std::abs(fitted.quad.normal.z), 1.0, 1e-3);
  }
}

TEST(FittedQuads, divide_an_l) {
  const std::vector<FittedQuad> quads = fit(l_shape());
  ASSERT_EQ(quads.size(), 2u);
  EXPECT_NEAR(quads[0].covered_m2 + quads[1].covered_m2, 28.0, 2.0);
  for (const FittedQuad& fitted : quads) EXPECT_GT(fitted.coverage(), 0.9);
}

TEST(FittedQuads, of_two_walls_in_a_plane_are_two) {
  const std::vector<FittedQuad> beside = fit({test::wall(0.0, 0.0, 3.0, 2.0), test::wall(4.0, 0.0, 3.0, 2.0)});
  ASSERT_EQ(beside.size(), 2u);
  const std::vector<FittedQuad> above = fit({test::wall(0.0, 0.0, 3.0, 2.0), test::wall(0.0, 6.0, 3.0, 2.0)});
  ASSERT_EQ(above.size(), 2u);
  for (const FittedQuad& fitted : above) EXPECT_NEAR(height(fitted), 2.0, 0.2);
}

TEST(FittedQuads, are_not_larger_than_the_limit) {
  const std::vector<FittedQuad> quads = fit({test::wall(0.0, 0.0, 47.0, 23.0)});
  double area = 0.0;
  for (const FittedQuad& fitted : quads) {
    EXPECT_LE(width(fitted), 10.3);
    EXPECT_LE(height(fitted), 10.3);
    area += fitted.covered_m2;
  }
  EXPECT_NEAR(area, 47.0 * 23.0, 20.0);
  EXPECT_EQ(quads.size(), 15u);
}

TEST(FittedQuads, of_a_sphere_are_none) {
  EXPECT_TRUE(fit({test::sphere(0.3)}).empty());
  EXPECT_TRUE(fit({test::sphere(1.0)}).empty());
}

TEST(FittedQuads, of_nothing_tiny_or_broken_things_are_none) {
  EXPECT_TRUE(fit({}).empty());
  EXPECT_TRUE(fit(Meshes(2)).empty());
  EXPECT_TRUE(fit({test::wall(0.0, 0.0, 0.9, 0.9)}).empty());
  EXPECT_TRUE(fit({test::wall(0.0, 0.0, 40.0, 0.3)}).empty());
  FitTriangles broken = test::wall(0.0, 0.0, 5.0, 5.0);
  for (dvec3& p : broken.positions) p.y = test::kNaN;
  EXPECT_TRUE(fit({broken}).empty());
  EXPECT_TRUE(fit({test::rectangle(dvec3(0.0), {0.0, 0.0, 9.0}, {9.0, 0.0, 0.0})}).empty()) << "a floor";
}

TEST(FittedQuads, of_a_mesh_that_is_there_twice_are_the_same) {
  const FitTriangles room = test::box(dvec3(0.0), dvec3(4.0, 3.0, 5.0), true);
  const std::vector<FittedQuad> once = fit({room});
  const std::vector<FittedQuad> twice = fit({room, room});
  ASSERT_EQ(once.size(), twice.size());
  for (std::size_t i = 0; i < once.size(); ++i)
    EXPECT_LT(glm::length(once[i].quad.center - twice[i].quad.center), 1e-9);
}

TEST(FittedQuads, of_double_sided_walls_face_both_ways) {
  FitTriangles banner = test::wall(0.0, 0.0, 3.0, 2.0);
  banner.double_sided = true;
  const std::vector<FittedQuad> quads = fit({banner});
  ASSERT_EQ(quads.size(), 2u);
  EXPECT_NEAR(glm::dot(quads[0].quad.normal, quads[1].quad.normal), -1.0, 1e-9);
  for (const FittedQuad& fitted : quads) expect_rectangle(fitted);
}

TEST(FittedQuads, of_a_turned_ceiling_follow_its_sides) {
  const dvec3 u(std::cos(0.5), 0.0, std::sin(0.5));
  const dvec3 v(-std::sin(0.5), 0.0, std::cos(0.5));
  const std::vector<FittedQuad> quads = fit({test::rectangle({3.0, 4.0, 5.0}, u * 8.0, v * 3.0)});
  ASSERT_EQ(quads.size(), 1u);
  EXPECT_NEAR(quads[0].quad.normal.y, -1.0, 1e-9);
  EXPECT_GT(quads[0].coverage(), 0.85);
  EXPECT_NEAR(std::max(width(quads[0]), height(quads[0])), 8.0, 0.5);
}

TEST(FittedQuads, do_not_depend_on_threads) {
  Meshes meshes = l_shape();
  meshes.push_back(test::sphere(3.0));
  for (int i = 0; i < 40; ++i) meshes.push_back(test::box(dvec3(3.0 * i, 0.0, 4.0), dvec3(3.0 * i + 2.0, 3.0, 6.0)));
  const std::vector<FittedQuad> serial = candidate_quads(meshes, QuadSettings(), *make_serial_executor());
  EXPECT_GT(serial.size(), 100u);
  for (const std::uint32_t threads : {1u, 2u, 8u}) {
    const std::vector<FittedQuad> pooled = candidate_quads(meshes, QuadSettings(), *make_pool_executor(threads));
    ASSERT_EQ(pooled.size(), serial.size());
    for (std::size_t i = 0; i < serial.size(); ++i) EXPECT_EQ(pooled[i].quad, serial[i].quad);
  }
}

TEST(FittedQuads, for_choosing_include_the_divided_ones) {
  const std::vector<FittedQuad> quads = candidate_quads(l_shape(), QuadSettings(), *make_serial_executor());
  EXPECT_TRUE(std::ranges::any_of(quads, [](const FittedQuad& q) { return width(q) > 7.0 && height(q) > 7.0; }));
  EXPECT_TRUE(std::ranges::any_of(quads, [](const FittedQuad& q) { return width(q) < 2.3 && height(q) > 5.5; }));
}

}  // namespace
}  // namespace gloam
