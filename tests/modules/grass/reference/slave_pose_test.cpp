// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/reference/slave_pose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace gloam::test {
namespace {

TEST(SlavePose, a_slave_of_a_resting_master_rests_in_its_own_direction) {
  for (const double yaw : {0.0, 0.4, 3.0, 6.1}) {
    const SlaveStem master{dvec3(0.0, 1.0, 0.0), 5.0, 0.3};
    const SlaveStem slave{dvec3(0.0, 1.0, 0.0), yaw, 0.45};
    const dvec3 tip = 0.1 * blade_forward(master.normal, master.yaw) + 0.28 * master.normal;
    const dvec3 expected = 1.5 * (0.1 * blade_forward(slave.normal, slave.yaw) + 0.28 * slave.normal);
    const SlaveTurn turn = slave_turn(master, slave, 7, tip, tip, 0.0);
    EXPECT_LT(glm::length(slave_knot(turn, tip) - expected), 1e-9) << yaw;
  }
}

TEST(SlavePose, lengths_keep_their_ratio_and_knots_stay_over_the_ground) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const auto normal = [&] { return glm::normalize(dvec3(0.6 * unit(random), 1.0, 0.6 * unit(random))); };
    const SlaveStem master{normal(), 3.0 + 3.0 * unit(random), 0.3};
    const SlaveStem slave{normal(), 3.0 + 3.0 * unit(random), 0.2 + 0.15 * unit(random)};
    dvec3 knot = dvec3(unit(random), unit(random), unit(random)) * 0.3;
    knot += master.normal * std::max(0.0, -glm::dot(knot, master.normal));
    const dvec3 tip = dvec3(unit(random), unit(random), unit(random)) * 0.3;
    const SlaveTurn turn =
        slave_turn(master, slave, random() % 256, tip, dvec3(0.0, 0.3, 0.0), 5.0 + 5.0 * unit(random));
    const dvec3 at = slave_knot(turn, knot);
    EXPECT_NEAR(glm::length(at), glm::length(knot) * slave.length_m / master.length_m, 1e-9);
    EXPECT_NEAR(glm::dot(at, slave.normal), glm::dot(knot, master.normal) * slave.length_m / master.length_m, 1e-9);
  }
}

TEST(SlavePose, a_bent_master_bends_its_slaves_in_its_own_direction) {
  const SlaveStem master{dvec3(0.0, 1.0, 0.0), 0.0, 0.3};
  const SlaveStem slave{dvec3(0.0, 1.0, 0.0), 2.0, 0.3};
  const dvec3 bent(0.0, 0.15, 0.25);
  const SlaveTurn turn = slave_turn(master, slave, 1, bent, dvec3(0.05, 0.29, 0.0), 0.0);
  EXPECT_LT(glm::length(slave_knot(turn, bent) - bent), 1e-9);
}

TEST(SlavePose, slaves_of_a_moving_master_part) {
  const SlaveStem stem{dvec3(0.0, 1.0, 0.0), 0.0, 0.3};
  const dvec3 tip(0.1, 0.25, 0.0);
  double least = 1.0, most = -1.0;
  for (std::uint32_t slot = 0; slot < 16; ++slot) {
    const double z = slave_knot(slave_turn(stem, stem, slot, tip, tip, 1.0), tip).z;
    least = std::min(least, z);
    most = std::max(most, z);
    EXPECT_LT(std::abs(slave_knot(slave_turn(stem, stem, slot, tip, tip, 0.0), tip).z), 1e-12) << "at rest they do not";
  }
  EXPECT_GT(most - least, 0.02);
}

TEST(SlavePose, a_master_without_length_gives_finite_knots) {
  const SlaveStem none{dvec3(0.0, 1.0, 0.0), 0.0, 0.0};
  const SlaveStem slave{dvec3(0.0, -1.0, 0.0), 1.0, 0.3};
  const dvec3 at = slave_knot(slave_turn(none, slave, 1, dvec3(0.0), dvec3(0.0), 0.0), dvec3(0.0));
  EXPECT_EQ(glm::length(at), 0.0);
}

}  // namespace
}  // namespace gloam::test
