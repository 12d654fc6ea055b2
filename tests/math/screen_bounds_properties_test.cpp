// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <utility>

#include "engine/math/screen_bounds.h"
#include "tests/math/generators.h"
#include "tests/math/silhouette.h"
#include "tests/support/property.h"

namespace gloam {
namespace {

/// Bound on the oracle's own error, in normalised device coordinates: points in double lose a few ulps of the size of
/// the coordinates, and the projection divides that by the depth, which is at least the near distance.
double oracle_noise(dvec3 center, double size, const PerspectiveScale& projection) {
  const double magnitude = glm::length(center) + size;
  const double scale = std::max(projection.scale.x, projection.scale.y);
  return 1e-12 + 2e-14 * magnitude / projection.near_m * scale;
}

/// The screen rectangle that the body's silhouette covers, by brute force.
NdcRect covered(const test::SupportPoint& support, const PerspectiveScale& projection) {
  NdcRect rect{vec2(0.0f), vec2(0.0f), false};
  for (int axis = 0; axis < 2; ++axis) {
    const double low = -test::reach(support, axis, -1.0, projection.near_m) * projection.scale[axis];
    const double high = test::reach(support, axis, 1.0, projection.near_m) * projection.scale[axis];
    rect.empty |= !(low <= high) || low > 1.0 || high < -1.0;
    rect.min[axis] = static_cast<float>(std::clamp(low, -1.0, 1.0));
    rect.max[axis] = static_cast<float>(std::clamp(high, -1.0, 1.0));
  }
  return rect;
}

/// Asserts that no visible sample lies outside the rectangle.
void check_contains_samples(const NdcRect& rect, const test::SupportPoint& support, dvec3 inside,
                            const PerspectiveScale& projection, double noise) {
  int outside = 0;
  const auto visit = [&](dvec3 p) {
    const double x = p.x / -p.z * projection.scale.x;
    const double y = p.y / -p.z * projection.scale.y;
    if (std::abs(x) > 1.0 - noise || std::abs(y) > 1.0 - noise) return;
    const bool in_rect = !rect.empty && x >= rect.min.x - noise && x <= rect.max.x + noise && y >= rect.min.y - noise &&
                         y <= rect.max.y + noise;
    outside += in_rect ? 0 : 1;
  };
  test::sample_surface(support, projection.near_m, 400, visit);
  if (-inside.z >= projection.near_m) visit(inside);
  RC_ASSERT(outside == 0);
}

/// The body grown by 1e-12 of its size and distance, the rounding error that a rectangle in double may have. Where a
/// body just touches the near plane, this is much more than 1e-12 on the screen.
test::SupportPoint grown(test::SupportPoint support, dvec3 center, double size) {
  const double by = 1e-12 * (glm::length(center) + size);
  return [support = std::move(support), by](dvec3 direction) { return support(direction) + by * direction; };
}

/// Asserts that the rectangle contains `least`, that of the body's silhouette, and lies within `most`, that of the
/// grown body, except for the widening.
void check_tight(const NdcRect& rect, const NdcRect& least, const NdcRect& most, double noise) {
  constexpr double kTolerance = 1e-6;
  if (rect.empty || most.empty) {  // a body that just touches the screen's edge may count as visible or not
    const NdcRect& other = rect.empty ? least : rect;
    const double sliver = kTolerance + noise;
    RC_ASSERT(other.empty || other.max.x - other.min.x <= sliver || other.max.y - other.min.y <= sliver);
    return;
  }
  for (int axis = 0; axis < 2; ++axis) {
    if (!least.empty) RC_ASSERT(rect.min[axis] <= least.min[axis] + noise);
    if (!least.empty) RC_ASSERT(rect.max[axis] >= least.max[axis] - noise);
    RC_ASSERT(rect.min[axis] >= most.min[axis] - kTolerance);
    RC_ASSERT(rect.max[axis] <= most.max[axis] + kTolerance);
  }
}

/// Whether a rectangle covers a part of the screen: neither nothing nor all of it.
bool is_part_of_screen(const NdcRect& rect) {
  return !rect.empty && (rect.min != vec2(-1.0f) || rect.max != vec2(1.0f));
}

TEST(SphereBoundsProperties, hold_every_visible_sample) {
  test::check_property(1500, [] {
    const PerspectiveScale projection = test::draw_projection();
    const Sphere sphere = test::draw_sphere(projection.near_m);
    test::log_case(sphere, projection);
    const double noise = oracle_noise(sphere.center, sphere.radius, projection);
    check_contains_samples(screen_bounds(sphere, projection), test::support_of(sphere), sphere.center, projection,
                           noise);
  });
}

TEST(SphereBoundsProperties, equal_the_silhouette) {
  int telling = 0;
  test::check_property(1500, [&] {
    const PerspectiveScale projection = test::draw_projection();
    const Sphere sphere = test::draw_sphere(projection.near_m);
    test::log_case(sphere, projection);
    const double noise = oracle_noise(sphere.center, sphere.radius, projection);
    const test::SupportPoint support = test::support_of(sphere);
    const NdcRect rect = screen_bounds(sphere, projection);
    telling += is_part_of_screen(rect) ? 1 : 0;
    check_tight(rect, covered(support, projection), covered(grown(support, sphere.center, sphere.radius), projection),
                noise);
  });
  EXPECT_GE(telling, test::scaled(1500) / 5);
}

TEST(ConeBoundsProperties, hold_every_visible_sample) {
  test::check_property(1500, [] {
    const PerspectiveScale projection = test::draw_projection();
    const Cone cone = test::draw_cone(projection.near_m);
    test::log_case(cone, projection);
    const double noise = oracle_noise(cone.apex, cone.range_m, projection);
    const dvec3 middle = dvec3(cone.apex) + 0.5 * cone.range_m * dvec3(cone.axis);
    check_contains_samples(screen_bounds(cone, projection), test::support_of(cone), middle, projection, noise);
  });
}

TEST(ConeBoundsProperties, equal_the_silhouette) {
  int telling = 0;
  test::check_property(1500, [&] {
    const PerspectiveScale projection = test::draw_projection();
    const Cone cone = test::draw_cone(projection.near_m);
    test::log_case(cone, projection);
    const double noise = oracle_noise(cone.apex, cone.range_m, projection);
    const test::SupportPoint support = test::support_of(cone);
    const NdcRect rect = screen_bounds(cone, projection);
    telling += is_part_of_screen(rect) ? 1 : 0;
    check_tight(rect, covered(support, projection), covered(grown(support, cone.apex, cone.range_m), projection),
                noise);
  });
  EXPECT_GE(telling, test::scaled(1500) / 5);
}

TEST(ConeBoundsProperties, never_exceed_those_of_the_bounding_sphere) {
  test::check_property(1500, [] {
    const PerspectiveScale projection = test::draw_projection();
    const Cone cone = test::draw_cone(projection.near_m);
    test::log_case(cone, projection);
    const NdcRect own = screen_bounds(cone, projection);
    const NdcRect around = screen_bounds(bounding_sphere(cone), projection);
    if (own.empty) return;
    RC_ASSERT(!around.empty);
    for (int axis = 0; axis < 2; ++axis) {
      RC_ASSERT(own.min[axis] >= around.min[axis]);
      RC_ASSERT(own.max[axis] <= around.max[axis]);
      RC_ASSERT(own.min[axis] <= own.max[axis]);
    }
  });
}

TEST(ScreenBoundsProperties, any_value_that_is_no_number_gives_the_whole_screen) {
  test::check_property(300, [] {
    const PerspectiveScale projection = test::draw_projection();
    const float odd =
        test::draw_index(2) == 0 ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
    Sphere sphere = test::draw_sphere(projection.near_m);
    Cone cone = test::draw_cone(projection.near_m);
    float* const sphere_fields[] = {&sphere.center.x, &sphere.center.y, &sphere.center.z, &sphere.radius};
    *sphere_fields[test::draw_index(4)] = odd;
    float* const cone_fields[] = {&cone.apex.x, &cone.apex.y, &cone.apex.z,     &cone.axis.x,
                                  &cone.axis.y, &cone.axis.z, &cone.half_angle, &cone.range_m};
    *cone_fields[test::draw_index(8)] = odd;
    for (const NdcRect& rect : {screen_bounds(sphere, projection), screen_bounds(cone, projection)}) {
      RC_ASSERT(!rect.empty);
      RC_ASSERT(rect.min == vec2(-1.0f));
      RC_ASSERT(rect.max == vec2(1.0f));
    }
  });
}

}  // namespace
}  // namespace gloam
