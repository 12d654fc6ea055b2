// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/commands/cost_cameras.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>

namespace gloam {
namespace {

dvec3 forward(const dmat4& pose) { return -dvec3(pose[2]); }

dmat4 turned_by(double angle, const dvec3& place) {
  return glm::rotate(glm::translate(dmat4(1.0), place), angle, dvec3(0.0, 1.0, 0.0));
}

TEST(pose_between, moves_and_turns_evenly) {
  const dmat4 from = turned_by(0.0, {2.0, 0.0, 0.0}), to = turned_by(-1.2, {4.0, 8.0, 0.0});
  for (const double part : {0.0, 0.25, 0.5, 1.0}) {
    const dmat4 pose = pose_between(from, to, part);
    EXPECT_LT(glm::length(dvec3(pose[3]) - dvec3(2.0 + 2.0 * part, 8.0 * part, 0.0)), 1e-12) << part;
    EXPECT_LT(glm::length(forward(pose) - forward(turned_by(-1.2 * part, dvec3(0.0)))), 1e-12) << part;
    EXPECT_LT(glm::length(dvec3(pose[1]) - dvec3(0.0, 1.0, 0.0)), 1e-12) << "it stays upright at " << part;
  }
}

TEST(pose_between, turns_by_the_shortest_way) {
  const dmat4 pose = pose_between(turned_by(3.0, dvec3(0.0)), turned_by(-3.0, dvec3(0.0)), 0.5);
  EXPECT_LT(glm::length(forward(pose) - dvec3(0.0, 0.0, 1.0)), 1e-12);
}

TEST(pose_between, leaves_scale_and_mirror_out) {
  const dmat4 scaled = glm::scale(turned_by(0.5, {1.0, 2.0, 3.0}), dvec3(-4.0, 0.1, 7.0));
  const dmat4 pose = pose_between(scaled, scaled, 0.5);
  EXPECT_NEAR(glm::determinant(pose), 1.0, 1e-12);
  EXPECT_LT(glm::length(forward(pose) - forward(turned_by(0.5, dvec3(0.0)))), 1e-12);
  EXPECT_EQ(dvec3(pose[3]), dvec3(1.0, 2.0, 3.0));
}

TEST(MeasuredCamera, is_named_by_its_place_on_the_path) {
  MeasuredCamera camera;
  camera.options.camera = "court";
  EXPECT_EQ(camera.name(), "court");
  camera.towards = "lawn";
  camera.part = 0.75;
  EXPECT_EQ(camera.name(), "court to lawn, 0.75 of the way");
}

}  // namespace
}  // namespace gloam
