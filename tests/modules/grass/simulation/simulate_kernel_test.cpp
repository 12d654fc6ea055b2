// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include "tests/modules/grass/support/simulate_kernel.h"

namespace gloam::test {
namespace {

class GrassSimulation : public KernelTest {
 protected:
  [[nodiscard]] static GrassInput field(const std::vector<std::uint32_t>& patches, const std::vector<float>& stiffness,
                                        vec3 wind) {
    GrassInput input;
    for (const float s : stiffness) input.types.push_back(leaning_type(s));
    std::uint32_t seed = 1;
    for (const std::uint32_t count : patches) add_patch(input, count, seed++);
    input.steps.wind = {wind, 0.5f, vec3(3.0f, 0.0f, 200.0f)};
    return input;
  }
};

TEST_F(GrassSimulation, a_step_moves_the_knots_as_the_twin_does) {
  for (const std::uint32_t iterations : {1u, 3u, 8u}) {
    SCOPED_TRACE(iterations);
    GrassInput input = field({100, 33}, {0.05f, 0.1f, 0.2f, 0.7f, 1.0f, 0.0f}, vec3(6.0f, 0.5f, -3.0f));
    input.steps.iterations = iterations;
    SimulateTwin twin(input);
    const SimulateKernel kernel(device());
    for (int frame = 0; frame < 6; ++frame) {
      input.steps.frame_steps = 1 + frame % 3;
      twin.advance(input.steps);
      kernel.advance(input, 1);
      EXPECT_LT(twin.distance(input.knots), 2e-5) << "frame " << frame;
      expect_sound(twin, input.knots);
    }
  }
}

}  // namespace
}  // namespace gloam::test
