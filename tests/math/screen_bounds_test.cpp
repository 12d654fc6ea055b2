// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/math/screen_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr PerspectiveScale kUnit{vec2(1.0f), 0.1f};

void expect_rect(const NdcRect& rect, vec2 min, vec2 max, float tolerance = 1e-6f) {
  EXPECT_FALSE(rect.empty);
  EXPECT_NEAR(rect.min.x, min.x, tolerance);
  EXPECT_NEAR(rect.min.y, min.y, tolerance);
  EXPECT_NEAR(rect.max.x, max.x, tolerance);
  EXPECT_NEAR(rect.max.y, max.y, tolerance);
}

void expect_whole_screen(const NdcRect& rect) { expect_rect(rect, vec2(-1.0f), vec2(1.0f), 0.0f); }

TEST(SphereBounds, ahead_are_those_of_the_tangent_cone) {
  const float slope = 3.0f / 4.0f;  // radius 3 at distance 5: the tangent has length 4
  expect_rect(screen_bounds(Sphere{vec3(0.0f, 0.0f, -5.0f), 3.0f}, kUnit), vec2(-slope), vec2(slope));
}

TEST(SphereBounds, follow_the_scale_of_each_axis) {
  const PerspectiveScale wide{vec2(0.5f, 1.25f), 0.1f};
  expect_rect(screen_bounds(Sphere{vec3(0.0f, 0.0f, -5.0f), 3.0f}, wide), vec2(-0.375f, -0.9375f),
              vec2(0.375f, 0.9375f));
}

TEST(SphereBounds, beside_the_axis_are_not_centred_on_its_centre) {
  // Centre at x = 3, z = -4, radius 3: the tangents are the view axis and the line at twice the centre's angle.
  const double far_side = std::tan(2.0 * std::atan(3.0 / 4.0));
  const NdcRect rect = screen_bounds(Sphere{vec3(3.0f, 0.0f, -4.0f), 3.0f}, {vec2(0.25f), 0.1f});
  EXPECT_NEAR(rect.min.x, 0.0f, 1e-6f);
  EXPECT_NEAR(rect.max.x, 0.25 * far_side, 1e-6);
}

TEST(SphereBounds, are_clipped_to_the_screen) {
  expect_whole_screen(screen_bounds(Sphere{vec3(0.0f, 0.0f, -2.0f), 1.99f}, kUnit));
}

TEST(SphereBounds, around_the_camera_reach_as_far_as_the_near_plane_section) {
  const PerspectiveScale projection{vec2(0.5f), 1.0f};
  const float section = std::sqrt(1.5f * 1.5f - 1.0f);
  expect_rect(screen_bounds(Sphere{vec3(0.0f), 1.5f}, projection), vec2(-0.5f * section), vec2(0.5f * section));
}

TEST(SphereBounds, behind_the_near_plane_are_empty) {
  EXPECT_TRUE(screen_bounds(Sphere{vec3(0.0f, 0.0f, 5.0f), 3.0f}, kUnit).empty);
  EXPECT_TRUE(screen_bounds(Sphere{vec3(0.0f, 0.0f, 0.0f), 0.09f}, kUnit).empty);
  EXPECT_FALSE(screen_bounds(Sphere{vec3(0.0f, 0.0f, 0.0f), 0.11f}, kUnit).empty);
}

TEST(SphereBounds, beyond_the_screen_are_empty) {
  EXPECT_TRUE(screen_bounds(Sphere{vec3(20.0f, 0.0f, -10.0f), 1.0f}, kUnit).empty);
  EXPECT_TRUE(screen_bounds(Sphere{vec3(0.0f, -20.0f, -10.0f), 1.0f}, kUnit).empty);
}

TEST(SphereBounds, a_radius_of_zero_is_a_point) {
  expect_rect(screen_bounds(Sphere{vec3(1.0f, -2.0f, -4.0f), 0.0f}, kUnit), vec2(0.25f, -0.5f), vec2(0.25f, -0.5f));
  EXPECT_FALSE(screen_bounds(Sphere{vec3(0.0f, 0.0f, -0.1f), 0.0f}, kUnit).empty);
}

TEST(SphereBounds, of_a_huge_sphere_beside_the_camera_stay_exact) {
  // The surface is half a metre to the left of the camera. The near plane cuts the sphere; the right bound is the
  // tangent through the camera.
  const Sphere wall{vec3(-1e6f, 0.0f, 0.0f), 999999.5f};
  const NdcRect rect = screen_bounds(wall, {vec2(1.0f), 0.1f});
  EXPECT_EQ(rect.min.x, -1.0f);
  EXPECT_NEAR(rect.max.x, -std::sqrt(1e12 - 999999.5 * 999999.5) / 999999.5, 1e-6);
}

TEST(SphereBounds, no_number_gives_the_whole_screen) {
  expect_whole_screen(screen_bounds(Sphere{vec3(kNan, 0.0f, 5.0f), 1.0f}, kUnit));
  expect_whole_screen(screen_bounds(Sphere{vec3(0.0f, 0.0f, 5.0f), kNan}, kUnit));
  expect_whole_screen(screen_bounds(Sphere{vec3(0.0f, 0.0f, 5.0f), 1.0f}, {vec2(kNan, 1.0f), 0.1f}));
  expect_whole_screen(screen_bounds(Sphere{vec3(0.0f, 0.0f, 5.0f), 1.0f}, {vec2(1.0f), kNan}));
}

TEST(SphereBounds, misuse_asserts) {
  EXPECT_ASSERT((void)screen_bounds(Sphere{vec3(0.0f), -1.0f}, kUnit), "radius");
  EXPECT_ASSERT((void)screen_bounds(Sphere{}, (PerspectiveScale{vec2(0.0f), 0.1f})), "scale");
  EXPECT_ASSERT((void)screen_bounds(Sphere{}, (PerspectiveScale{vec2(1.0f), 0.0f})), "near");
}

TEST(ConeBounds, looking_away_show_the_rim_or_the_cap) {
  // The rim has radius 3 at depth 14. The cap bulges behind the rim and stays inside its projection.
  const Cone cone{vec3(0.0f, 0.0f, -10.0f), vec3(0.0f, 0.0f, -1.0f), static_cast<float>(std::atan(0.75)), 5.0f};
  expect_rect(screen_bounds(cone, kUnit), vec2(-3.0f / 14.0f), vec2(3.0f / 14.0f));
}

TEST(ConeBounds, pointing_sideways_run_from_apex_to_cap) {
  const Cone cone{vec3(0.0f, 0.0f, -10.0f), vec3(1.0f, 0.0f, 0.0f), 0.6f, 5.0f};
  const NdcRect rect = screen_bounds(cone, kUnit);
  EXPECT_NEAR(rect.min.x, 0.0f, 1e-6f);
  // The bound is the tangent to the sphere of radius 5 around the apex at distance 10; it touches inside the cap.
  EXPECT_NEAR(rect.max.x, 5.0 / std::sqrt(75.0), 1e-6);
  EXPECT_NEAR(rect.max.y, -rect.min.y, 1e-6f);
  EXPECT_LT(rect.max.y, rect.max.x);
}

TEST(ConeBounds, of_a_thin_cone_are_those_of_its_axis) {
  const Cone cone{vec3(-1.0f, -1.0f, -4.0f), vec3(0.6f, 0.8f, 0.0f), 1e-4f, 2.0f};
  expect_rect(screen_bounds(cone, kUnit), vec2(-0.25f), vec2(0.05f, 0.15f), 1e-4f);
}

TEST(ConeBounds, from_behind_the_camera_shine_past_it) {
  // The apex is 10 m behind the camera and the cone opens forwards: only its part beyond the near plane is visible.
  const Cone cone{vec3(5.0f, 0.0f, 10.0f), vec3(0.0f, 0.0f, -1.0f), 0.1f, 100.0f};
  const NdcRect rect = screen_bounds(cone, kUnit);
  EXPECT_FALSE(rect.empty);
  EXPECT_EQ(rect.max.x, 1.0f);
  // The left flank at its far end: x = 5 m - 100 m · sin(0.1), 100 m · cos(0.1) - 10 m ahead.
  EXPECT_NEAR(rect.min.x, (5.0 - 100.0 * std::sin(0.1)) / (100.0 * std::cos(0.1) - 10.0), 1e-3);
  EXPECT_EQ(rect.max.y, 1.0f);
}

TEST(ConeBounds, pointing_away_behind_the_camera_are_empty) {
  EXPECT_TRUE(screen_bounds(Cone{vec3(0.0f, 0.0f, 1.0f), vec3(0.0f, 0.0f, 1.0f), 1.0f, 10.0f}, kUnit).empty);
  // The bounding sphere reaches beyond the near plane; the cone does not.
  EXPECT_TRUE(screen_bounds(Cone{vec3(0.0f, 0.0f, 0.05f), vec3(0.0f, 0.0f, 1.0f), 1.5f, 10.0f}, kUnit).empty);
}

TEST(ConeBounds, a_range_of_zero_is_a_point) {
  expect_rect(screen_bounds(Cone{vec3(1.0f, 1.0f, -4.0f), vec3(1.0f, 0.0f, 0.0f), 0.5f, 0.0f}, kUnit), vec2(0.25f),
              vec2(0.25f));
}

TEST(ConeBounds, a_hemisphere_ends_at_its_disc) {
  const NdcRect rect = screen_bounds(Cone{vec3(0.0f, 0.0f, -10.0f), vec3(1.0f, 0.0f, 0.0f), kPi / 2.0f, 5.0f}, kUnit);
  EXPECT_NEAR(rect.min.x, 0.0f, 1e-6f);
  EXPECT_NEAR(rect.max.x, 5.0 / std::sqrt(75.0), 1e-6);
  EXPECT_NEAR(rect.max.y, 5.0 / std::sqrt(75.0), 1e-6);
}

TEST(ConeBounds, no_number_gives_the_whole_screen) {
  expect_whole_screen(screen_bounds(Cone{vec3(0.0f, 0.0f, 5.0f), vec3(0.0f, kNan, 1.0f), 0.5f, 1.0f}, kUnit));
  expect_whole_screen(screen_bounds(Cone{vec3(0.0f, 0.0f, 5.0f), vec3(0.0f, 0.0f, 1.0f), kNan, 1.0f}, kUnit));
  expect_whole_screen(screen_bounds(Cone{vec3(0.0f, 0.0f, 5.0f), vec3(0.0f, 0.0f, 1.0f), 0.5f, kNan}, kUnit));
}

TEST(ConeBounds, misuse_asserts) {
  const vec3 ahead(0.0f, 0.0f, -5.0f);
  EXPECT_ASSERT((void)screen_bounds(Cone{ahead, vec3(0.0f, 0.0f, 2.0f), 0.5f, 1.0f}, kUnit), "unit vector");
  EXPECT_ASSERT((void)screen_bounds(Cone{ahead, vec3(0.0f, 0.0f, 1.0f), 1.8f, 1.0f}, kUnit), "half angle");
}

}  // namespace
}  // namespace gloam
