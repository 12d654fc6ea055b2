// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/fitting/caught_rays.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>

#include "tests/modules/reflections/fitting/fit_scene.h"

namespace gloam {
namespace {

/// A ray at 45° toward −z from a receiver 3 m before the plane z = 0: it meets the plane 3 m up, after √18 m.
ReflectedRay ray_at(double x, double hit_m) {
  return {.eye = {x, 1.5, 4.5},
          .receiver = {x, 0.0, 3.0},
          .direction = glm::normalize(dvec3(0.0, 1.0, -1.0)),
          .hit_m = hit_m};
}

const double kWallDistance_m = std::sqrt(18.0);

CaughtRays caught(const std::vector<PlacedProxy>& proxies, const std::vector<ReflectedRay>& rays) {
  return caught_rays(proxies, {}, rays, *make_serial_executor());
}

TEST(CaughtRays, are_within_a_quarter_metre_along_the_ray) {
  const std::vector<PlacedProxy> proxies = {test::proxy_at({0.0, 3.0, 0.0}, {0.0, 0.0, 1.0}, 10.0, 2.0)};
  const double d = kWallDistance_m;
  const CaughtRays result =
      caught(proxies, {ray_at(0.0, d), ray_at(0.0, d + 0.24), ray_at(0.0, d - 0.24), ray_at(0.0, d + 0.26),
                       ray_at(0.0, d - 0.26), ray_at(0.0, kNoHit), ray_at(5.5, d), ray_at(5.5, kNoHit)});
  EXPECT_EQ(result.rays, 8u);
  EXPECT_EQ(result.surface_rays, 6u);
  EXPECT_EQ(result.caught, 3u);
  EXPECT_EQ(result.misplaced, 3u) << "two too far, and one before the sky";
  EXPECT_DOUBLE_EQ(result.share(), 0.5);
}

TEST(CaughtRays, count_the_first_proxy_only) {
  const PlacedProxy right = test::proxy_at({0.0, 3.0, 0.0}, {0.0, 0.0, 1.0}, 10.0, 2.0);
  const PlacedProxy before = test::proxy_at({0.0, 2.0, 1.0}, {0.0, 0.0, 1.0}, 10.0, 2.0);
  const PlacedProxy behind = test::proxy_at({0.0, 4.0, -1.0}, {0.0, 0.0, 1.0}, 10.0, 2.0);
  const PlacedProxy turned = test::proxy_at({0.0, 2.0, 1.0}, {0.0, 0.0, -1.0}, 10.0, 2.0);
  const std::vector<ReflectedRay> ray = {ray_at(0.0, kWallDistance_m)};
  EXPECT_EQ(caught({right, behind}, ray).caught, 1u);
  EXPECT_EQ(caught({before, right}, ray).caught, 0u);
  EXPECT_EQ(caught({before, right}, ray).misplaced, 1u);
  EXPECT_EQ(caught({turned, right}, ray).caught, 1u) << "the back of a proxy is not hit";
}

TEST(CaughtRays, are_none_without_proxies_or_rays) {
  EXPECT_EQ(caught({}, {ray_at(0.0, 4.0)}).share(), 0.0);
  EXPECT_EQ(caught({}, {}).share(), 0.0);
  EXPECT_EQ(caught({}, {ray_at(0.0, kNoHit)}).share(), 0.0);
}

TEST(CaughtRays, need_the_rooms_of_the_eye) {
  const std::vector<PlacedProxy> proxies = {test::proxy_at({0.0, 3.0, 0.0}, {0.0, 0.0, 1.0}, 4.0, 2.0)};
  const std::vector<ReflectedRay> rays = {ray_at(0.0, kWallDistance_m)};
  const auto room = [](const dvec3& center, const vec3& size) {
    PlacedRoom placed;
    EXPECT_TRUE(place_room(kNoEntity, {.size_m = size}, nullptr, glm::translate(dmat4(1.0), center), placed));
    return placed;
  };
  const auto share = [&](const std::vector<PlacedRoom>& rooms) {
    return caught_rays(proxies, rooms, rays, *make_serial_executor());
  };
  EXPECT_EQ(share({room({0.0, 2.0, 3.0}, {10.0f, 8.0f, 10.0f})}).caught, 1u) << "both inside";
  EXPECT_EQ(share({room({0.0, 2.0, 5.0}, {4.0f, 8.0f, 4.0f})}).caught, 0u) << "only the eye inside";
  EXPECT_EQ(share({room({0.0, 2.0, 5.0}, {4.0f, 8.0f, 4.0f})}).in_rooms, 0u);
  EXPECT_EQ(share({room({0.0, 3.0, 0.0}, {2.0f, 2.0f, 2.0f})}).caught, 0u) << "only the proxy inside";
  EXPECT_EQ(share({room({90.0, 3.0, 0.0}, {2.0f, 2.0f, 2.0f})}).caught, 1u) << "both outside";
  EXPECT_EQ(share({room({90.0, 3.0, 0.0}, {2.0f, 2.0f, 2.0f})}).in_rooms, 1u);
  EXPECT_EQ(share({room({0.0, 6.0, 3.0}, {10.0f, 9.9f, 10.0f})}).caught, 0u) << "the receiver is below the floor";
}

TEST(ProxyMeetings, are_those_of_a_traced_rectangle) {
  std::vector<PlacedProxy> proxies;
  std::vector<FitTriangles> traced;
  std::vector<ReflectedRay> rays;
  for (int i = 0; i < 12; ++i) {
    const double angle = 0.5 * i;
    proxies.push_back(test::proxy_at({std::sin(angle) * 5.0, 1.0 + 0.3 * i, std::cos(angle) * 5.0},
                                     {-std::sin(angle + 0.3), 0.2, -std::cos(angle + 0.3)}, 3.0, 2.0));
    const PlacedProxy& p = proxies.back();
    traced.push_back(test::rectangle(p.center - p.half_u - p.half_v, 2.0 * p.half_u, 2.0 * p.half_v));
  }
  for (int i = 0; i < 400; ++i) {
    const double angle = 0.1 * i;
    const double steep = 0.05 + 0.002 * i;
    rays.push_back({.eye = {0.0, 2.0, 0.0},
                    .receiver = {0.01 * i - 2.0, 0.0, 0.3},
                    .direction = glm::normalize(dvec3(std::sin(angle), steep, std::cos(angle)))});
  }
  const auto meetings = meet_rays(proxies, {}, rays, *make_serial_executor());
  std::size_t met = 0;
  for (std::size_t p = 0; p < proxies.size(); ++p) {
    std::size_t next = 0;
    for (std::uint32_t r = 0; r < rays.size(); ++r) {
      const bool front = glm::dot(proxies[p].normal, rays[r].direction) < 0.0;
      const double expected =
          front ? test::nearest_hit(std::span(&traced[p], 1), rays[r].receiver, rays[r].direction) : kNoHit;
      if (!std::isfinite(expected)) continue;
      ASSERT_LT(next, meetings[p].size());
      EXPECT_EQ(meetings[p][next].ray, r);
      EXPECT_NEAR(static_cast<double>(meetings[p][next].distance_m), expected, 1e-5);
      EXPECT_NEAR(hit_distance(proxies[p], rays[r]), expected, 1e-9);
      ++next;
    }
    EXPECT_EQ(next, meetings[p].size());
    met += next;
  }
  EXPECT_GT(met, 100u);
}

}  // namespace
}  // namespace gloam
