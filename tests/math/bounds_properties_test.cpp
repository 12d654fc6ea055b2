// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "engine/math/bounds.h"
#include "tests/math/generators.h"
#include "tests/math/silhouette.h"
#include "tests/support/property.h"

namespace gloam {
namespace {

TEST(BoundingSphereProperties, holds_every_point_of_the_cone) {
  test::check_property(2000, [] {
    const Cone cone = test::draw_cone(0.1);
    const Sphere sphere = bounding_sphere(cone);
    const test::SupportPoint support = test::support_of(cone);
    const double noise = 1e-14 * (glm::length(dvec3(cone.apex)) + cone.range_m);
    for (int i = 0; i < 100; ++i) {
      const dvec3 p = support(test::draw_direction());
      RC_ASSERT(glm::length(p - dvec3(sphere.center)) <= sphere.radius + noise);
    }
  });
}

TEST(BoundingSphereProperties, is_no_larger_than_the_smallest_but_for_rounding) {
  test::check_property(2000, [] {
    const Cone cone = test::draw_cone(0.1);
    const Sphere sphere = bounding_sphere(cone);
    // Least possible radius. Wide cones: half the distance of two opposite rim points. Narrow cones: the circumradius
    // of the apex and two opposite rim points.
    const double angle = cone.half_angle;
    const double smallest =
        angle > 0.25 * kPi ? cone.range_m * std::sin(angle) : cone.range_m / (2.0 * std::cos(angle));
    const double rounding = 4e-7 * (glm::length(dvec3(cone.apex)) + cone.range_m);
    RC_ASSERT(sphere.radius <= smallest + rounding);
  });
}

TEST(TransformedAabbProperties, holds_the_transformed_corners) {
  test::check_property(3000, [] {
    mat4 affine(1.0f);
    for (int column = 0; column < 4; ++column) {
      affine[column] = vec4(test::draw_direction() * test::draw_length(-6.0, 6.0), column == 3 ? 1.0 : 0.0);
    }
    Aabb box;
    box.grow(vec3(test::draw_direction() * test::draw_length(-6.0, 6.0)));
    box.grow(vec3(test::draw_direction() * test::draw_length(-6.0, 6.0)));
    const Aabb result = transformed(box, affine);
    Aabb corners;
    for (int corner = 0; corner < 8; ++corner) {
      const dvec4 p((corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
                    (corner & 4) != 0 ? box.max.z : box.min.z, 1.0);
      corners.grow(vec3(dmat4(affine) * p));
    }
    for (int axis = 0; axis < 3; ++axis) {
      double size = std::abs(affine[3][axis]);
      for (int column = 0; column < 3; ++column) {
        size += std::abs(affine[column][axis]) * std::max(std::abs(box.min[column]), std::abs(box.max[column]));
      }
      RC_ASSERT(result.min[axis] <= corners.min[axis]);
      RC_ASSERT(result.max[axis] >= corners.max[axis]);
      RC_ASSERT(result.min[axis] >= corners.min[axis] - 2.5e-7 * size);
      RC_ASSERT(result.max[axis] <= corners.max[axis] + 2.5e-7 * size);
    }
  });
}

}  // namespace
}  // namespace gloam
