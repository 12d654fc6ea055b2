// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/fitting/receivers.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/modules/reflections/fitting/fit_scene.h"

namespace gloam {
namespace {

FitTriangles square(double x, double z, double size, double y) {
  return test::rectangle({x, y, z}, {0.0, 0.0, size}, {size, 0.0, 0.0});
}

TEST(UpTriangles, leave_out_walls_ceilings_and_broken_triangles) {
  const FitTriangles room = test::box(dvec3(0.0), dvec3(4.0, 3.0, 5.0), true);
  EXPECT_NEAR(UpTriangles(test::up_triangles(room)).area_m2(), 20.0, 1e-9);
  const UpTriangle broken{{dvec3(0.0), dvec3(test::kNaN), dvec3(1.0)}};
  EXPECT_TRUE(UpTriangles(std::span(&broken, 1)).empty());
  EXPECT_TRUE(UpTriangles({}).empty());
}

TEST(UpTriangles, are_found_where_a_scan_of_all_finds_them) {
  std::vector<UpTriangle> triangles;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(0.0, 40.0);
  for (int i = 0; i < 60; ++i) {
    const double size = i < 3 ? 30.0 : 2.0;
    for (const UpTriangle& t : test::up_triangles(square(at(random), at(random), size, 0.5 * (i % 5))))
      triangles.push_back(t);
  }
  const UpTriangles up(triangles);
  for (int i = 0; i < 4000; ++i) {
    const double height = 0.5 * (i % 6);
    const dvec3 point(at(random) * 1.8, height + 0.01, at(random) * 1.8);
    bool expected = false;
    for (std::size_t t = 0; t < triangles.size(); t += 2) {  // the halves of a square
      const dvec3 low = triangles[t].corners[0], high = triangles[t].corners[2];
      expected |= std::abs(low.y - height) < 1e-9 && point.x >= low.x && point.x <= high.x && point.z >= low.z &&
                  point.z <= high.z;
    }
    const auto found = up.height_at(point, 0.02);
    ASSERT_EQ(found.has_value(), expected) << point.x << " " << point.z;
    if (!found) continue;
    EXPECT_NEAR(*found, height, 1e-9);
  }
}

TEST(UpTriangles, are_sampled_by_area) {
  std::vector<UpTriangle> triangles = test::up_triangles(square(0.0, 0.0, 1.0, 0.0));
  for (const UpTriangle& t : test::up_triangles(square(100.0, 0.0, 3.0, 1.0))) triangles.push_back(t);
  const UpTriangles up(triangles);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int small = 0;
  dvec3 mean(0.0);
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    const double pick = unit(random), u = unit(random);
    const dvec3 p = up.sample(pick, u, unit(random));
    ASSERT_TRUE(up.height_at(p, 1e-6).has_value());
    if (p.x < 50.0)
      ++small;
    else
      mean += p;
  }
  EXPECT_NEAR(small, kSamples / 10, 150);
  mean /= kSamples - small;
  EXPECT_NEAR(mean.x, 101.5, 0.05);
  EXPECT_NEAR(mean.z, 1.5, 0.05);
}

}  // namespace
}  // namespace gloam
