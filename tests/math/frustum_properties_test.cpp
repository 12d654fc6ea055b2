// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <glm/vector_relational.hpp>

#include "engine/math/frustum.h"
#include "tests/math/generators.h"
#include "tests/support/property.h"

namespace gloam {
namespace {

struct View {
  mat4 clip_from_world;
  dmat4 world_from_view;
};

/// A perspective or orthographic camera with any orientation, up to a thousand kilometres from the origin.
View draw_view() {
  const dvec3 forward = test::draw_direction();
  const dvec3 helper = std::abs(forward.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
  const dvec3 right = glm::normalize(glm::cross(forward, helper));
  const dvec3 up = glm::cross(right, forward);
  const dvec3 position = test::draw_direction() * (test::draw_index(3) == 0 ? 0.0 : test::draw_length(-1.0, 6.0));
  dmat4 world_from_view(1.0);
  world_from_view[0] = dvec4(right, 0.0);
  world_from_view[1] = dvec4(up, 0.0);
  world_from_view[2] = dvec4(-forward, 0.0);
  world_from_view[3] = dvec4(position, 1.0);
  const auto near_m = static_cast<float>(test::draw_length(-3.0, 0.0));
  const bool perspective = test::draw_index(3) != 0;
  const mat4 clip_from_view = perspective
                                  ? reversed_perspective(static_cast<float>(test::draw(0.05, 3.0)),
                                                         static_cast<float>(test::draw(0.3, 3.0)), near_m)
                                  : reversed_orthographic(static_cast<float>(test::draw_length(-1.0, 3.0)),
                                                          static_cast<float>(test::draw_length(-1.0, 3.0)), near_m,
                                                          near_m + static_cast<float>(test::draw_length(0.0, 5.0)));
  return {clip_from_view * mat4(glm::inverse(world_from_view)), world_from_view};
}

/// Whether the point is visible through the matrix that the frustum was made from, computed in double.
bool is_visible(const mat4& clip_from_world, dvec3 p) {
  const dvec4 c = dmat4(clip_from_world) * dvec4(p, 1.0);
  return std::abs(c.x) <= c.w && std::abs(c.y) <= c.w && c.z >= 0.0 && c.z <= c.w;
}

/// A point in or near the frustum: in front of the camera, often near the edges of the picture.
dvec3 draw_point(const View& view) {
  const double distance = test::draw_length(-3.0, 5.0);
  const dvec3 in_view(test::draw(-1.5, 1.5) * distance, test::draw(-1.5, 1.5) * distance, -distance);
  return dvec3(view.world_from_view * dvec4(in_view, 1.0));
}

TEST(FrustumProperties, a_sphere_that_holds_a_visible_point_is_never_rejected) {
  int tried = 0;
  test::check_property(6000, [&] {
    const View view = draw_view();
    const dvec3 point = draw_point(view);
    const double radius = test::draw_length(-6.0, 6.0);
    // Mostly the point lies on the sphere's surface, so that the sphere barely reaches into the frustum.
    const double depth = test::draw_index(4) == 0 ? test::draw(0.0, 1.0) : 1.0;
    const Sphere sphere{vec3(point + test::draw_direction() * radius * depth), static_cast<float>(radius)};
    if (glm::length(dvec3(sphere.center) - point) > sphere.radius) return;
    if (!is_visible(view.clip_from_world, point)) return;
    ++tried;
    RC_ASSERT(may_intersect(frustum_from_clip(view.clip_from_world), sphere));
  });
  EXPECT_GE(tried, test::scaled(6000) / 50);
}

TEST(FrustumProperties, a_box_that_holds_a_visible_point_is_never_rejected) {
  int tried = 0;
  test::check_property(6000, [&] {
    const View view = draw_view();
    const dvec3 point = draw_point(view);
    Aabb box{vec3(point), vec3(point)};
    for (int axis = 0; axis < 3; ++axis) {
      const auto size = static_cast<float>(test::draw_length(-6.0, 6.0));
      (test::draw_index(2) == 0 ? box.min[axis] -= size : box.max[axis] += size);
    }
    const bool in_box =
        glm::all(glm::lessThanEqual(dvec3(box.min), point)) && glm::all(glm::lessThanEqual(point, dvec3(box.max)));
    const dvec3 inside = in_box ? point : dvec3(vec3(point));
    if (!is_visible(view.clip_from_world, inside)) return;
    ++tried;
    RC_ASSERT(may_intersect(frustum_from_clip(view.clip_from_world), box));
  });
  EXPECT_GE(tried, test::scaled(6000) / 50);
}

TEST(FrustumProperties, a_sphere_well_beyond_one_plane_is_rejected) {
  test::check_property(2000, [] {
    const View view = draw_view();
    const Frustum frustum = frustum_from_clip(view.clip_from_world);
    const Plane& plane = frustum.planes[static_cast<std::size_t>(test::draw_index(5))];
    const double radius = test::draw_length(-3.0, 3.0);
    const dvec3 origin(view.world_from_view[3]);
    const double distance = glm::dot(dvec3(plane.normal), origin) + plane.distance;
    const double slack = 1e-5 * (1.0 + glm::length(origin) + std::abs(distance) + radius);
    const dvec3 center = origin - dvec3(plane.normal) * (distance + radius + slack);
    RC_ASSERT(!may_intersect(frustum, Sphere{vec3(center), static_cast<float>(radius)}));
  });
}

}  // namespace
}  // namespace gloam
