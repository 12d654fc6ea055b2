// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/math/bounds.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

bool is_nan(vec3 v) { return std::isnan(v.x) && std::isnan(v.y) && std::isnan(v.z); }

mat4 translation(vec3 by) {
  mat4 m(1.0f);
  m[3] = vec4(by, 1.0f);
  return m;
}

TEST(Aabb, the_default_is_empty_and_grows_from_nothing) {
  Aabb box;
  EXPECT_TRUE(box.empty());
  box.grow(vec3(1.0f, 2.0f, 3.0f));
  EXPECT_FALSE(box.empty());
  EXPECT_EQ(box.min, box.max);
  box.grow(vec3(-1.0f, 4.0f, 3.0f));
  EXPECT_EQ(box.center(), vec3(0.0f, 3.0f, 3.0f));
  EXPECT_EQ(box.half_extent(), vec3(1.0f, 1.0f, 0.0f));
}

TEST(Aabb, growing_by_an_empty_box_changes_nothing) {
  Aabb box{vec3(0.0f), vec3(1.0f)};
  box.grow(Aabb{});
  EXPECT_EQ(box.min, vec3(0.0f));
  EXPECT_EQ(box.max, vec3(1.0f));
}

TEST(TransformedAabb, moves_with_a_translation) {
  const Aabb box = transformed({vec3(-1.0f), vec3(2.0f)}, translation(vec3(10.0f, 20.0f, 30.0f)));
  EXPECT_EQ(box.min, vec3(9.0f, 19.0f, 29.0f));
  EXPECT_EQ(box.max, vec3(12.0f, 22.0f, 32.0f));
}

TEST(TransformedAabb, is_the_box_of_the_eight_corners) {
  mat4 m = translation(vec3(3.0f, -2.0f, 0.5f));
  m[0] = vec4(0.5f, -2.0f, 0.25f, 0.0f);
  m[1] = vec4(-1.5f, 0.125f, 4.0f, 0.0f);
  m[2] = vec4(0.0f, 1.0f, -1.0f, 0.0f);
  const Aabb box{vec3(-1.0f, 2.0f, -3.0f), vec3(4.0f, 2.5f, 7.0f)};
  Aabb expected;
  for (int corner = 0; corner < 8; ++corner) {
    expected.grow(vec3(m * vec4((corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
                                (corner & 4) != 0 ? box.max.z : box.min.z, 1.0f)));
  }
  const Aabb result = transformed(box, m);
  EXPECT_EQ(result.min, expected.min);  // all numbers have few digits, so nothing rounds
  EXPECT_EQ(result.max, expected.max);
}

TEST(TransformedAabb, an_empty_box_stays_empty) { EXPECT_TRUE(transformed(Aabb{}, translation(vec3(5.0f))).empty()); }

TEST(TransformedAabb, an_endless_box_stays_endless_without_becoming_no_number) {
  const Aabb box{vec3(-kInfinity, 0.0f, 0.0f), vec3(kInfinity, 1.0f, 1.0f)};
  const Aabb result = transformed(box, translation(vec3(1.0f)));
  EXPECT_EQ(result.min, vec3(-kInfinity, 1.0f, 1.0f));
  EXPECT_EQ(result.max, vec3(kInfinity, 2.0f, 2.0f));
}

TEST(TransformedAabb, no_number_spreads_to_the_whole_box) {
  const Aabb box{vec3(0.0f), vec3(1.0f, NAN, 1.0f)};
  EXPECT_TRUE(is_nan(transformed(box, mat4(1.0f)).min));
  EXPECT_TRUE(is_nan(transformed({vec3(0.0f), vec3(1.0f)}, translation(vec3(NAN))).max));
}

TEST(BoundingSphere, of_a_narrow_cone_passes_through_apex_and_rim) {
  const Cone cone{vec3(1.0f, 2.0f, 3.0f), vec3(0.0f, 1.0f, 0.0f), kPi / 6.0f, 10.0f};
  const Sphere sphere = bounding_sphere(cone);
  EXPECT_NEAR(sphere.radius, 10.0 / (2.0 * std::cos(kPi / 6.0)), 1e-5);
  EXPECT_NEAR(sphere.center.y, 2.0f + sphere.radius, 1e-5f);
  EXPECT_FLOAT_EQ(sphere.center.x, 1.0f);
}

TEST(BoundingSphere, of_a_wide_cone_has_the_rim_as_a_great_circle) {
  const Cone cone{vec3(0.0f), vec3(0.0f, 0.0f, -1.0f), kPi / 3.0f, 2.0f};
  const Sphere sphere = bounding_sphere(cone);
  EXPECT_NEAR(sphere.radius, 2.0 * std::sin(kPi / 3.0), 1e-5);
  EXPECT_NEAR(sphere.center.z, -1.0f, 1e-5f);
}

TEST(BoundingSphere, of_a_hemisphere_is_its_sphere) {
  const Sphere sphere = bounding_sphere(Cone{vec3(0.0f), vec3(1.0f, 0.0f, 0.0f), kPi / 2.0f, 3.0f});
  EXPECT_NEAR(sphere.radius, 3.0f, 1e-5f);
  EXPECT_NEAR(glm::length(sphere.center), 0.0f, 1e-5f);
}

TEST(BoundingSphere, of_a_box_touches_its_corners) {
  const Sphere sphere = bounding_sphere(Aabb{vec3(-1.0f), vec3(1.0f, 3.0f, 1.0f)});
  EXPECT_EQ(sphere.center, vec3(0.0f, 1.0f, 0.0f));
  EXPECT_NEAR(sphere.radius, std::sqrt(6.0f), 1e-6f);
}

TEST(BoundingSphere, misuse_asserts) {
  EXPECT_ASSERT((void)bounding_sphere(Aabb{}), "empty box");
  EXPECT_ASSERT((void)bounding_sphere(Cone{.half_angle = 2.0f, .range_m = 1.0f}), "half angle");
  EXPECT_ASSERT((void)bounding_sphere(Cone{.half_angle = 1.0f, .range_m = -1.0f}), "range");
}

}  // namespace
}  // namespace gloam
