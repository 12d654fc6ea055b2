// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/math/frustum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

vec3 to_ndc(const mat4& clip, vec3 p) {
  const vec4 c = clip * vec4(p, 1.0f);
  return vec3(c.x, c.y, c.z) / c.w;
}

Frustum right_angle() { return frustum_from_clip(reversed_perspective(kPi / 2.0f, 1.0f, 0.5f)); }

TEST(ReversedPerspective, depth_is_near_over_distance) {
  const mat4 clip = reversed_perspective(1.0f, 1.5f, 0.25f);
  for (const float distance : {0.25f, 1.0f, 100.0f, 1e6f}) {
    EXPECT_FLOAT_EQ(to_ndc(clip, vec3(0.0f, 0.0f, -distance)).z, 0.25f / distance);
  }
}

TEST(ReversedPerspective, the_field_of_view_spans_the_screen) {
  const mat4 clip = reversed_perspective(kPi / 2.0f, 2.0f, 0.1f);
  EXPECT_NEAR(to_ndc(clip, vec3(0.0f, 5.0f, -5.0f)).y, 1.0f, 1e-6f);
  EXPECT_NEAR(to_ndc(clip, vec3(-10.0f, 0.0f, -5.0f)).x, -1.0f, 1e-6f);
}

TEST(ReversedPerspective, misuse_asserts) {
  EXPECT_ASSERT((void)reversed_perspective(0.0f, 1.0f, 0.1f), "field of view");
  EXPECT_ASSERT((void)reversed_perspective(3.2f, 1.0f, 0.1f), "field of view");
  EXPECT_ASSERT((void)reversed_perspective(1.0f, 0.0f, 0.1f), "positive");
  EXPECT_ASSERT((void)reversed_perspective(1.0f, 1.0f, -0.1f), "positive");
}

TEST(ReversedOrthographic, depth_runs_from_one_at_near_to_zero_at_far) {
  const mat4 clip = reversed_orthographic(2.0f, 3.0f, 1.0f, 9.0f);
  EXPECT_NEAR(to_ndc(clip, vec3(0.0f, 0.0f, -1.0f)).z, 1.0f, 1e-6f);
  EXPECT_NEAR(to_ndc(clip, vec3(0.0f, 0.0f, -5.0f)).z, 0.5f, 1e-6f);
  EXPECT_NEAR(to_ndc(clip, vec3(0.0f, 0.0f, -9.0f)).z, 0.0f, 1e-6f);
  EXPECT_NEAR(to_ndc(clip, vec3(2.0f, -3.0f, -5.0f)).x, 1.0f, 1e-6f);
  EXPECT_NEAR(to_ndc(clip, vec3(2.0f, -3.0f, -5.0f)).y, -1.0f, 1e-6f);
}

TEST(FrustumFromClip, planes_come_in_order_with_unit_normals_pointing_inwards) {
  const float s = std::sqrt(0.5f);
  const Frustum frustum = right_angle();
  const vec3 normals[] = {{s, 0, -s}, {-s, 0, -s}, {0, s, -s}, {0, -s, -s}, {0, 0, -1}};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(glm::length(frustum.planes[i].normal - normals[i]), 0.0f, 1e-6f);
  EXPECT_FLOAT_EQ(frustum.planes[4].distance, -0.5f);
}

TEST(FrustumFromClip, an_infinite_far_plane_holds_everything) {
  EXPECT_EQ(right_angle().planes[5].normal, vec3(0.0f));
  EXPECT_EQ(right_angle().planes[5].distance, 1.0f);
}

TEST(FrustumFromClip, an_orthographic_far_plane_is_where_it_was_put) {
  const Plane far = frustum_from_clip(reversed_orthographic(1.0f, 1.0f, 0.0f, 100.0f)).planes[5];
  EXPECT_NEAR(far.normal.z, 1.0f, 1e-6f);
  EXPECT_NEAR(far.distance, 100.0f, 1e-4f);
}

TEST(MayIntersect, spheres_inside_outside_and_across) {
  const Frustum frustum = right_angle();
  EXPECT_TRUE(may_intersect(frustum, Sphere{vec3(0.0f, 0.0f, -10.0f), 1.0f}));
  EXPECT_TRUE(may_intersect(frustum, Sphere{vec3(0.0f, 0.0f, -1e6f), 0.0f}));
  EXPECT_TRUE(may_intersect(frustum, Sphere{vec3(-11.0f, 0.0f, -10.0f), 1.0f}));
  EXPECT_FALSE(may_intersect(frustum, Sphere{vec3(-12.0f, 0.0f, -10.0f), 1.0f}));
  EXPECT_FALSE(may_intersect(frustum, Sphere{vec3(12.0f, 0.0f, -10.0f), 1.0f}));
  EXPECT_FALSE(may_intersect(frustum, Sphere{vec3(0.0f, -12.0f, -10.0f), 1.0f}));
  EXPECT_FALSE(may_intersect(frustum, Sphere{vec3(0.0f, 12.0f, -10.0f), 1.0f}));
  EXPECT_FALSE(may_intersect(frustum, Sphere{vec3(0.0f, 0.0f, 1.0f), 1.0f}));
  EXPECT_FALSE(may_intersect(frustum, Sphere{vec3(0.0f, 0.0f, 1.0f), 1.49f}));
  EXPECT_TRUE(may_intersect(frustum, Sphere{vec3(0.0f, 0.0f, 1.0f), 1.51f}));
}

TEST(MayIntersect, boxes_inside_outside_and_across) {
  const Frustum frustum = right_angle();
  const auto box = [](vec3 center, float half) { return Aabb{center - half, center + half}; };
  EXPECT_TRUE(may_intersect(frustum, box(vec3(0.0f, 0.0f, -10.0f), 1.0f)));
  EXPECT_TRUE(may_intersect(frustum, box(vec3(0.0f), 1e6f)));
  EXPECT_TRUE(may_intersect(frustum, box(vec3(11.0f, 0.0f, -10.0f), 1.0f)));
  EXPECT_FALSE(may_intersect(frustum, box(vec3(12.5f, 0.0f, -10.0f), 1.0f)));
  EXPECT_FALSE(may_intersect(frustum, box(vec3(0.0f, -12.5f, -10.0f), 1.0f)));
  EXPECT_FALSE(may_intersect(frustum, box(vec3(0.0f, 0.0f, 1.0f), 1.0f)));
}

TEST(MayIntersect, an_orthographic_far_plane_rejects_what_is_behind_it) {
  const Frustum frustum = frustum_from_clip(reversed_orthographic(1.0f, 1.0f, 0.0f, 100.0f));
  EXPECT_TRUE(may_intersect(frustum, Sphere{vec3(0.0f, 0.0f, -99.0f), 0.5f}));
  EXPECT_FALSE(may_intersect(frustum, Sphere{vec3(0.0f, 0.0f, -101.0f), 0.5f}));
}

TEST(MayIntersect, an_empty_box_is_outside) { EXPECT_FALSE(may_intersect(right_angle(), Aabb{})); }

TEST(MayIntersect, a_volume_with_no_number_in_it_is_never_outside) {
  const Frustum frustum = right_angle();
  EXPECT_TRUE(may_intersect(frustum, Sphere{vec3(kNan, 0.0f, 10.0f), 1.0f}));
  EXPECT_TRUE(may_intersect(frustum, Sphere{vec3(0.0f, 0.0f, 10.0f), kNan}));
  for (int axis = 0; axis < 3; ++axis) {
    Aabb low{vec3(9.0f), vec3(10.0f)};
    Aabb high = low;
    low.min[axis] = kNan;
    high.max[axis] = kNan;
    EXPECT_TRUE(may_intersect(frustum, low)) << axis;
    EXPECT_TRUE(may_intersect(frustum, high)) << axis;
  }
}

TEST(MayIntersect, endless_volumes_are_never_outside) {
  EXPECT_TRUE(may_intersect(right_angle(), Sphere{vec3(0.0f, 0.0f, 10.0f), kInfinity}));
  EXPECT_TRUE(may_intersect(right_angle(), Aabb{vec3(-kInfinity), vec3(kInfinity)}));
}

}  // namespace
}  // namespace gloam
