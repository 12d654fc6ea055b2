// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "modules/grass/reference/slave_pose.h"
#include "shaders/grass_test/shaders.h"
#include "tests/support/kernel.h"

namespace gloam::test {
namespace {

struct TestSlave {
  vec3 master_normal;
  float master_yaw;
  float master_length_m;
  vec3 slave_normal;
  float slave_yaw;
  float slave_length_m;
  std::uint32_t slot;
  vec3 rest_tip;
  float tip_speed;
  vec3 master_knots[GLOAM_GRASS_KNOTS];
};

class GrassSlaveKernel : public KernelTest {};

TEST_F(GrassSlaveKernel, has_the_knots_of_the_twin) {
  std::mt19937 random(8);
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
  const auto normal = [&] { return glm::normalize(vec3(0.5f * unit(random), 1.0f, 0.5f * unit(random))); };
  std::vector<TestSlave> slaves(640);
  for (TestSlave& s : slaves) {
    s = {normal(),
         3.0f + 3.0f * unit(random),
         0.3f,
         normal(),
         3.0f + 3.0f * unit(random),
         0.25f + 0.2f * unit(random),
         static_cast<std::uint32_t>(random() % 256),
         vec3(0.1f, 0.28f, 0.0f),
         2.0f + 2.0f * unit(random)};
    for (vec3& knot : s.master_knots)
      knot = vec3(0.1f * unit(random), 0.15f + 0.15f * unit(random), 0.1f * unit(random));
  }
  slaves[0].master_length_m = 0.0f;
  slaves[1].slave_length_m = 0.0f;
  slaves[2].tip_speed = 0.0f;
  Kernel kernel(device(), shaders::grass_test::slave_knots_comp);
  kernel.input(0, slaves);
  kernel.output(1, slaves.size() * GLOAM_GRASS_KNOTS * sizeof(vec4));
  kernel.run(static_cast<std::uint32_t>(slaves.size() / 64));
  const std::vector<vec4> found = kernel.read<vec4>(1);
  for (std::size_t i = 1; i < slaves.size(); ++i) {
    const TestSlave& s = slaves[i];
    const SlaveStem master{dvec3(s.master_normal), static_cast<double>(s.master_yaw),
                           static_cast<double>(s.master_length_m)};
    const SlaveStem slave{dvec3(s.slave_normal), static_cast<double>(s.slave_yaw),
                          static_cast<double>(s.slave_length_m)};
    if (std::abs(std::abs(std::remainder(slave.yaw - master.yaw, 6.283185307179586)) - 3.14159) < 1e-3)
      continue;  // the yaws are opposite: rounding decides the direction of the turn
    const SlaveTurn turn = slave_turn(master, slave, s.slot, dvec3(s.master_knots[GLOAM_GRASS_KNOTS - 1]),
                                      dvec3(s.rest_tip), static_cast<double>(s.tip_speed));
    for (std::size_t k = 0; k < kGrassKnots; ++k) {
      const dvec3 expected = slave_knot(turn, dvec3(s.master_knots[k]));
      const dvec3 got(found[i * kGrassKnots + k]);
      EXPECT_LT(glm::length(got - expected), 2e-5) << i << ", knot " << k;
      EXPECT_NEAR(glm::length(got),
                  glm::length(dvec3(s.master_knots[k])) * slave.length_m / std::max(master.length_m, 1e-6),
                  0.003 * slave.length_m)
          << "lengths hold within 1 %";
    }
  }
  for (std::size_t k = 0; k < kGrassKnots; ++k)
    EXPECT_TRUE(std::isfinite(glm::length(found[k]))) << "a master without length";
}

}  // namespace
}  // namespace gloam::test
