// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/input/view_projection.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace gloam {
namespace {

ViewSettings tilted_view(bool orthographic) {
  ViewSettings view;
  view.width = 640;
  view.height = 360;
  view.camera.orthographic = orthographic;
  view.camera.fov_y = 0.9f;
  view.camera.half_width_m = 4.0f;
  view.camera.half_height_m = 2.25f;
  view.world_from_camera = glm::translate(dmat4(1.0), dvec3(1.0, 2.0, 3.0)) *
                           dmat4(glm::mat3_cast(glm::normalize(dquat(0.9, 0.2, -0.3, 0.1))));
  return view;
}

TEST(ViewProjection, a_line_of_sight_meets_the_position_that_it_is_for) {
  for (const bool orthographic : {false, true}) {
    const ViewSettings view = tilted_view(orthographic);
    for (const dvec3 seen : {dvec3(0.0, 0.0, -5.0), dvec3(1.0, -0.5, -3.0), dvec3(-2.0, 1.0, -40.0)}) {
      const dvec3 position = dvec3(view.world_from_camera * dvec4(seen, 1.0));
      const auto place = place_in_picture(view, position);
      ASSERT_TRUE(place);
      const SightLine sight = sight_line(view, *place);
      const dvec3 away = position - sight.from;
      EXPECT_LT(glm::length(away - sight.direction * glm::dot(away, sight.direction)), 1e-9);
      const auto met = in_facing_plane(view, sight, position);
      ASSERT_TRUE(met);
      EXPECT_LT(glm::distance(*met, position), 1e-9);
    }
  }
}

TEST(ViewProjection, the_middle_of_the_picture_is_straight_ahead_and_up_is_up) {
  const ViewSettings view = tilted_view(false);
  const auto at = [&](const dvec3& seen) {
    return *place_in_picture(view, dvec3(view.world_from_camera * dvec4(seen, 1.0)));
  };
  EXPECT_NEAR(at({0.0, 0.0, -7.0}).x, 320.0, 1e-9);
  EXPECT_NEAR(at({0.0, 0.0, -7.0}).y, 180.0, 1e-9);
  EXPECT_LT(at({0.0, 1.0, -7.0}).y, 180.0);
  EXPECT_GT(at({1.0, 0.0, -7.0}).x, 320.0);
}

TEST(ViewProjection, nothing_is_behind_the_camera) {
  const ViewSettings view = tilted_view(false);
  EXPECT_FALSE(place_in_picture(view, dvec3(view.world_from_camera * dvec4(0.0, 0.0, 1.0, 1.0))));
}

TEST(ViewProjection, finds_the_nearest_point_of_an_axis) {
  const ViewSettings view = tilted_view(false);
  const dvec3 origin = dvec3(view.world_from_camera * dvec4(0.3, 0.2, -6.0, 1.0)), axis(0.0, 1.0, 0.0);
  const auto place = place_in_picture(view, origin + axis * 0.7);
  ASSERT_TRUE(place);
  const auto along = nearest_on_axis(sight_line(view, *place), origin, axis);
  ASSERT_TRUE(along);
  EXPECT_NEAR(*along, 0.7, 1e-9);
  EXPECT_FALSE(nearest_on_axis({.from = origin, .direction = axis}, origin, axis)) << "seen from its end";
}

}  // namespace
}  // namespace gloam
