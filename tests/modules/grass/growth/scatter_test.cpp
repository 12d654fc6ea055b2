// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/growth/scatter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "modules/grass/field/mesh_surface.h"
#include "modules/grass/growth/curve.h"
#include "modules/grass/growth/relax.h"
#include "tests/jobs/executors.h"
#include "tests/modules/grass/growth/lawns.h"

namespace gloam {
namespace {

std::vector<ScatteredRoot> scattered(const GrowthSurface& surface, std::uint32_t count, std::uint32_t seed = 1) {
  return scatter_roots(surface, count, seed, *make_pool_executor(2));
}

void expect_inside(const GrowthSurface& surface, std::span<const ScatteredRoot> roots) {
  for (const ScatteredRoot& root : roots) {
    ASSERT_LT(root.triangle, surface.triangles.size());
    ASSERT_GE(root.weight1, 0.0);
    ASSERT_GE(root.weight2, 0.0);
    ASSERT_LE(root.weight1 + root.weight2, 1.0);
  }
}

TEST(Scatter, any_count_is_met_exactly_and_every_root_lies_in_its_triangle) {
  const GrowthSurface surface = growth_surface(test::lawn(1, 10.0f), dmat4(1.0));
  for (const std::uint32_t count : {0u, 1u, 2u, 3u, 4u, 5u, 63u, 65u, 255u, 257u, 1000u}) {
    const std::vector<ScatteredRoot> roots = scattered(surface, count);
    EXPECT_EQ(roots.size(), count);
    expect_inside(surface, roots);
  }
}

TEST(Scatter, a_surface_without_triangles_has_no_roots) {
  EXPECT_TRUE(scattered(growth_surface(Mesh{}, dmat4(1.0)), 10).empty());
}

TEST(Scatter, roots_of_two_big_triangles_are_spaced_like_blue_noise) {
  const GrowthSurface surface = growth_surface(test::lawn(1, 20.0f), dmat4(1.0));
  const std::vector<dvec3> points = test::positions_of(surface, scattered(surface, 4000));
  EXPECT_GE(test::clark_evans(points, surface.area_m2, 9.0), 1.3);
}

TEST(Scatter, roots_of_a_fine_hilly_lawn_are_spaced_like_blue_noise) {
  const GrowthSurface surface = growth_surface(test::lawn(120, 20.0f, &test::hills), dmat4(1.0));
  ASSERT_EQ(surface.triangles.size(), 28800u);
  const std::vector<ScatteredRoot> roots = scattered(surface, 4000);
  expect_inside(surface, roots);
  EXPECT_GE(test::clark_evans(test::positions_of(surface, roots), surface.area_m2, 9.0), 1.3);
}

TEST(Scatter, slivers_and_triangles_of_mixed_sizes_are_covered_evenly_too) {
  // Columns of very different widths: triangles from 20 m × 5 mm to 20 m × 9 m.
  std::vector<vec3> positions;
  std::vector<std::uint32_t> indices;
  std::uint32_t column = 0;
  for (const float x : {-10.0f, -9.995f, -9.9f, -9.0f, 0.0f, 0.005f, 0.01f, 0.02f, 9.0f, 10.0f}) {
    positions.emplace_back(x, 0.0f, -10.0f);
    positions.emplace_back(x, 0.0f, 10.0f);
    if (column > 0) {
      const std::uint32_t a = 2 * column - 2;
      indices.insert(indices.end(), {a, a + 1, a + 2, a + 2, a + 1, a + 3});
    }
    ++column;
  }
  const GrowthSurface surface = growth_surface(test::mesh_of(positions, indices), dmat4(1.0));
  ASSERT_EQ(surface.triangles.size(), 18u);
  EXPECT_NEAR(surface.area_m2, 400.0, 1e-3);
  EXPECT_GE(test::clark_evans(test::positions_of(surface, scattered(surface, 4000)), surface.area_m2, 9.0), 1.3);
}

TEST(Scatter, the_index_of_clark_and_evans_is_1_for_a_random_pattern) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-10.0, 10.0);
  std::vector<dvec3> points;
  for (int i = 0; i < 4000; ++i) points.emplace_back(place(random), 0.0, place(random));
  EXPECT_NEAR(test::clark_evans(points, 400.0, 9.0), 1.0, 0.05);
}

TEST(Scatter, regions_have_as_many_roots_as_their_area_calls_for) {
  const GrowthSurface surface = growth_surface(test::lawn(60, 20.0f, &test::hills), dmat4(1.0));
  constexpr std::uint32_t kCount = 20000;
  constexpr int kRegions = 10;  // a side
  std::vector<double> area(kRegions * kRegions);
  std::vector<double> found(area.size());
  const auto region = [](const dvec3& p) {
    const auto cell = [](double at) { return std::clamp(static_cast<int>((at + 10.0) / 2.0), 0, kRegions - 1); };
    return static_cast<std::size_t>(cell(p.z) * kRegions + cell(p.x));
  };
  for (const GrowthTriangle& t : surface.triangles)
    area[region((t.corners[0] + t.corners[1] + t.corners[2]) / 3.0)] += t.area_m2;
  for (const dvec3& p : test::positions_of(surface, scattered(surface, kCount))) found[region(p)] += 1.0;
  double chi_square = 0.0;
  for (std::size_t i = 0; i < area.size(); ++i) {
    const double expected = kCount * area[i] / surface.area_m2;
    EXPECT_NEAR(found[i], expected, 0.1 * expected) << i;
    chi_square += (found[i] - expected) * (found[i] - expected) / expected;
  }
  // A random pattern has about 99 here; an even one has much less.
  EXPECT_LT(chi_square, 30.0);
}

TEST(Scatter, the_path_through_the_surface_visits_triangles_by_area_exactly) {
  // Without relaxation the count of a triangle differs from its share by less than 2.
  const GrowthSurface surface = growth_surface(test::lawn(3, 5.0f, &test::hills), dmat4(1.0));
  const AreaCurve curve(surface);
  constexpr std::uint32_t kCount = 1000;
  std::vector<double> found(surface.triangles.size());
  for (std::uint32_t i = 0; i < kCount; ++i) found[curve.root(i, kCount, BladeRandom(9, i, 0)).triangle] += 1.0;
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], kCount * surface.triangles[i].area_m2 / surface.area_m2, 2.0);
}

TEST(Scatter, roots_do_not_gather_at_the_border) {
  const GrowthSurface surface = growth_surface(test::lawn(1, 20.0f), dmat4(1.0));
  constexpr double kCount = 10000.0;
  std::size_t near = 0;
  constexpr double kMargin = 0.1;  // half of the blades' distance
  for (const dvec3& p : test::positions_of(surface, scattered(surface, static_cast<std::uint32_t>(kCount))))
    near += std::max(std::abs(p.x), std::abs(p.z)) > 10.0 - kMargin ? 1 : 0;
  EXPECT_LT(static_cast<double>(near), 1.25 * kCount * (4.0 * kMargin / 20.0));
}

TEST(Scatter, floors_above_each_other_get_equal_shares) {
  Mesh mesh = test::lawn(40, 10.0f);
  for (int floor = 1; floor < 4; ++floor) {
    Primitive above = mesh.primitives[0];
    for (vec3& p : above.positions) p.y += 3.0f * static_cast<float>(floor);
    mesh.primitives.push_back(above);
  }
  const GrowthSurface surface = growth_surface(mesh, dmat4(1.0));
  const std::vector<dvec3> points = test::positions_of(surface, scattered(surface, 8000));
  std::array<int, 4> counts{};
  for (const dvec3& p : points) ++counts[static_cast<std::size_t>(std::lround(p.y / 3.0))];
  for (const int count : counts) EXPECT_NEAR(count, 2000, 100);
  EXPECT_GE(test::clark_evans(points, surface.area_m2, 4.5), 1.2);
}

TEST(Scatter, the_result_has_the_same_bits_on_every_executor) {
  const GrowthSurface surface = growth_surface(test::lawn(20, 20.0f, &test::hills), dmat4(1.0));
  const std::uint64_t expected = test::hash_of(scatter_roots(surface, 20000, 5, *make_serial_executor()));
  for (const test::ExecutorCase& c : test::all_executors())
    EXPECT_EQ(test::hash_of(scatter_roots(surface, 20000, 5, *c.make())), expected) << c.name;
  EXPECT_NE(test::hash_of(scattered(surface, 20000, 6)), expected);
}

TEST(Scatter, extreme_shapes_keep_their_roots_inside) {
  for (const float size : {1e-12f, 1e-6f, 1e6f, 1e12f}) {
    const GrowthSurface surface = growth_surface(
        test::mesh_of({{0, 0, 0}, {size, 0, 0}, {0, 0, -size}, {1e-3f * size, 0, 1e-6f * size}}, {0, 1, 2, 0, 3, 1}),
        dmat4(1.0));
    ASSERT_EQ(surface.triangles.size(), 2u) << size;
    const std::vector<ScatteredRoot> roots = scattered(surface, 500);
    EXPECT_EQ(roots.size(), 500u);
    expect_inside(surface, roots);
  }
}

TEST(Scatter, a_root_walks_across_edges_but_never_beyond_the_border) {
  const GrowthSurface surface = growth_surface(test::lawn(50, 1.0f), dmat4(1.0));
  // Both roots are at nearly the same place; the push is much longer than a triangle.
  std::vector<ScatteredRoot> roots = {{10, 0.3, 0.3}, {10, 0.3001, 0.3}};
  const std::vector<dvec3> before = test::positions_of(surface, roots);
  relax_roots(surface, 1, *make_serial_executor(), roots);
  expect_inside(surface, roots);
  const std::vector<dvec3> after = test::positions_of(surface, roots);
  EXPECT_GT(glm::length(after[1] - before[1]), 0.1);
  for (const dvec3& p : after) {
    EXPECT_LE(std::max(std::abs(p.x), std::abs(p.z)), 0.5);
    EXPECT_EQ(p.y, 0.0);
  }
}

}  // namespace
}  // namespace gloam
