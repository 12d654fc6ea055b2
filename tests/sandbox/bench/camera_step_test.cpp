// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/harness/camera_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace gloam {
namespace {

/// A camera at (3, 2, -1) that looks down by 30 degrees.
dmat4 tilted_camera() {
  return glm::translate(dmat4(1.0), {3.0, 2.0, -1.0}) *
         glm::rotate(dmat4(1.0), -std::numbers::pi / 6.0, dvec3(1.0, 0.0, 0.0));
}

TEST(CameraStep, turns_and_steps_by_shares_of_what_the_camera_sees) {
  for (const double seen_m : {1e-3, 8.0, 1e4}) {
    const dmat4 before = moved_camera(tilted_camera(), seen_m, 6.0);
    const dmat4 after = moved_camera(tilted_camera(), seen_m, 7.0);
    EXPECT_NEAR(glm::length(dvec3(after[3]) - dvec3(before[3])), seen_m / 2000.0, 1e-9 * seen_m + 1e-12);
    const dvec3 level_before = glm::normalize(dvec3(before[2].x, 0.0, before[2].z));
    const dvec3 level_after = glm::normalize(dvec3(after[2].x, 0.0, after[2].z));
    EXPECT_NEAR(std::acos(glm::dot(level_before, level_after)) * 180.0 / std::numbers::pi, 0.25, 1e-6);
    EXPECT_NEAR(after[2].y, before[2].y, 1e-12) << "the tilt stays";
    EXPECT_NEAR(glm::determinant(glm::dmat3(after)), 1.0, 1e-12);
  }
}

TEST(CameraStep, starts_at_the_pose_and_goes_both_ways) {
  const dmat4 pose = tilted_camera();
  for (int column = 0; column < 4; ++column)
    EXPECT_LT(glm::length(moved_camera(pose, 5.0, 0.0)[column] - pose[column]), 1e-12);
  const dvec3 ahead = dvec3(moved_camera(pose, 5.0, 9.0)[3]) - dvec3(pose[3]);
  const dvec3 behind = dvec3(moved_camera(pose, 5.0, -9.0)[3]) - dvec3(pose[3]);
  EXPECT_LT(glm::length(ahead + behind), 1e-12);
}

}  // namespace
}  // namespace gloam
