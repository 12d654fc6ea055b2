// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/fitting/choose_quads.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/modules/reflections/fitting/fit_scene.h"

namespace gloam {
namespace {

/// Rays toward −z that hit the plane z = 0 at these x, 2 m high.
std::vector<ReflectedRay> rays_at(const std::vector<double>& xs) {
  std::vector<ReflectedRay> rays;
  for (const double x : xs)
    rays.push_back({.eye = {x, 2.0, 4.0},
                    .receiver = {x, 0.0, 2.0},
                    .direction = glm::normalize(dvec3(0.0, 1.0, -1.0)),
                    .hit_m = std::sqrt(8.0)});
  return rays;
}

/// A wall piece from x0 to x1 around 2 m of height.
PlacedProxy piece(double x0, double x1, double z = 0.0) {
  return test::proxy_at({0.5 * (x0 + x1), 2.0, z}, {0.0, 0.0, 1.0}, x1 - x0, 4.0);
}

using Indices = std::vector<std::uint32_t>;

TEST(ChosenQuads, catch_the_most_rays_first) {
  const auto rays = rays_at({1.0, 2.0, 3.0, 11.0, 12.0, 21.0});
  const std::vector<PlacedProxy> candidates = {piece(20.0, 22.0), piece(10.0, 13.0), piece(0.0, 4.0),
                                               piece(30.0, 40.0)};
  EXPECT_EQ(choose_quads(candidates, 0, {}, rays, *make_serial_executor()), Indices{});
  EXPECT_EQ(choose_quads(candidates, 1, {}, rays, *make_serial_executor()), (Indices{2}));
  EXPECT_EQ(choose_quads(candidates, 2, {}, rays, *make_serial_executor()), (Indices{2, 1}));
  EXPECT_EQ(choose_quads(candidates, 9, {}, rays, *make_serial_executor()), (Indices{2, 1, 0}))
      << "the last one catches nothing";
}

TEST(ChosenQuads, do_not_hide_each_other) {
  const auto rays = rays_at({1.0, 2.0, 3.0});
  const std::vector<PlacedProxy> candidates = {piece(0.0, 4.0), piece(0.0, 4.0, 1.0)};
  EXPECT_EQ(choose_quads(candidates, 2, {}, rays, *make_serial_executor()), (Indices{0}));
}

TEST(ChosenQuads, are_exchanged_when_the_greedy_order_was_wrong) {
  // The first choice catches four of the six rays, but the two others together catch all.
  const auto rays = rays_at({1.0, 2.0, 3.0, 4.0, 5.0, 6.0});
  const std::vector<PlacedProxy> candidates = {piece(1.5, 5.5), piece(0.5, 3.5), piece(3.5, 6.5)};
  Indices chosen = choose_quads(candidates, 2, {}, rays, *make_serial_executor());
  std::ranges::sort(chosen);
  EXPECT_EQ(chosen, (Indices{1, 2}));
}

TEST(ChosenQuads, are_none_without_candidates_or_rays) {
  const std::vector<PlacedProxy> candidates = {piece(0.0, 4.0)};
  EXPECT_TRUE(choose_quads({}, 4, {}, rays_at({1.0}), *make_serial_executor()).empty());
  EXPECT_TRUE(choose_quads(candidates, 4, {}, {}, *make_serial_executor()).empty());
}

TEST(ChosenQuads, do_not_depend_on_threads) {
  std::vector<double> xs;
  std::vector<PlacedProxy> candidates;
  for (int i = 0; i < 500; ++i) xs.push_back(0.37 * (i * 7 % 500));
  for (int i = 0; i < 300; ++i) candidates.push_back(piece(0.6 * i, 0.6 * i + 1.0 + i % 7, 0.1 * (i % 4)));
  const auto rays = rays_at(xs);
  const Indices serial = choose_quads(candidates, 12, {}, rays, *make_serial_executor());
  EXPECT_EQ(serial.size(), 12u);
  for (const std::uint32_t threads : {1u, 2u, 8u})
    EXPECT_EQ(choose_quads(candidates, 12, {}, rays, *make_pool_executor(threads)), serial);
}

}  // namespace
}  // namespace gloam
