// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/math/view_projection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

/// A camera far from the origin, turned by `yaw` around Y.
dmat4 turned_camera(double yaw) {
  const double c = std::cos(yaw), s = std::sin(yaw);
  return dmat4(dvec4(c, 0.0, -s, 0.0), dvec4(0.0, 1.0, 0.0, 0.0), dvec4(s, 0.0, c, 0.0), dvec4(1e6, 2.0, -3e6, 1.0));
}

TEST(ViewProjection, maps_what_lies_before_the_camera_to_the_middle_of_the_screen) {
  const dmat4 camera = turned_camera(0.7);
  const ViewProjection view = view_projection(camera, reversed_perspective(1.0f, 1.5f, 0.25f), 0.25f, 300, 200);
  const dvec3 ahead = dvec3(camera[3]) - dvec3(camera[2]) * 8.0;
  const vec4 clip = view.clip_from_relative * vec4(view.relative(ahead), 1.0f);
  EXPECT_NEAR(clip.x / clip.w, 0.0f, 1e-6f);
  EXPECT_NEAR(clip.y / clip.w, 0.0f, 1e-6f);
  EXPECT_NEAR(clip.z / clip.w, 0.25f / 8.0f, 1e-6f);
  EXPECT_EQ(view.width, 300u);
  EXPECT_EQ(view.height, 200u);
  EXPECT_EQ(view.near_m, 0.25f);
}

TEST(ViewProjection, its_frustum_holds_what_the_camera_sees) {
  const dmat4 camera = turned_camera(-2.0);
  const ViewProjection view = view_projection(camera, reversed_perspective(1.0f, 1.5f, 0.25f), 0.25f, 300, 200);
  const auto seen = [&](const dvec3& in_view) {
    const dvec3 world(camera * dvec4(in_view, 1.0));
    return may_intersect(view.frustum, Sphere{view.relative(world), 0.01f});
  };
  const double up = std::tan(0.5);
  EXPECT_TRUE(seen(dvec3(0.0, 0.98 * up * 10.0, -10.0)));
  EXPECT_FALSE(seen(dvec3(0.0, 1.02 * up * 10.0, -10.0)));
  EXPECT_TRUE(seen(dvec3(0.98 * 1.5 * up * 10.0, 0.0, -10.0)));
  EXPECT_FALSE(seen(dvec3(1.02 * 1.5 * up * 10.0, 0.0, -10.0)));
  EXPECT_FALSE(seen(dvec3(0.0, 0.0, 10.0)));
}

TEST(ViewProjection, knows_orthographic_views) {
  EXPECT_TRUE(view_projection(dmat4(1.0), reversed_orthographic(2.0f, 1.0f, 0.1f, 9.0f), 0.1f, 2, 1).orthographic());
  EXPECT_FALSE(view_projection(dmat4(1.0), reversed_perspective(1.0f, 2.0f, 0.1f), 0.1f, 2, 1).orthographic());
}

TEST(ViewProjection, without_pixels_asserts) {
  EXPECT_ASSERT((void)view_projection(dmat4(1.0), reversed_perspective(1.0f, 2.0f, 0.1f), 0.1f, 0, 1), "one pixel");
}

}  // namespace
}  // namespace gloam
