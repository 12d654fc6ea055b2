// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/harness/camera_path.h"

#include <gtest/gtest.h>

#include <glm/glm.hpp>

namespace gloam {
namespace {

constexpr PathKey kKeys[] = {
    {{0.0, 2.0, 0.0}, {0.0, 1.0, -6.0}}, {{4.0, 2.0, -3.0}, {9.0, 1.0, -6.0}}, {{6.0, 5.0, 2.0}, {0.0, 0.0, 2.0}}};

TEST(CameraPath, goes_through_its_keys_and_looks_at_their_targets) {
  for (std::size_t i = 0; i < 3; ++i) {
    const dmat4 pose = path_pose(kKeys, i * 100, 300);
    EXPECT_LT(glm::length(dvec3(pose[3]) - kKeys[i].eye), 1e-9);
    const dvec3 towards = glm::normalize(kKeys[i].target - kKeys[i].eye);
    EXPECT_LT(glm::length(-dvec3(pose[2]) - towards), 1e-9);
  }
}

TEST(CameraPath, is_closed_smooth_and_rigid) {
  const dvec3 first(path_pose(kKeys, 0, 300)[3]);
  const dvec3 last(path_pose(kKeys, 299, 300)[3]);
  EXPECT_LT(glm::length(first - last), 0.1);
  for (std::size_t frame = 0; frame + 1 < 300; ++frame) {
    const dmat4 pose = path_pose(kKeys, frame, 300);
    EXPECT_LT(glm::length(dvec3(path_pose(kKeys, frame + 1, 300)[3]) - dvec3(pose[3])), 0.2);
    EXPECT_NEAR(glm::determinant(glm::dmat3(pose)), 1.0, 1e-9);
  }
}

TEST(CameraPath, of_one_key_stands_still) { EXPECT_EQ(dvec3(path_pose({kKeys, 1}, 7, 300)[3]), kKeys[0].eye); }

}  // namespace
}  // namespace gloam
