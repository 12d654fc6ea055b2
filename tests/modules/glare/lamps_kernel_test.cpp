// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/modules/glare/support/glare_kernel.h"

namespace gloam::test {
namespace {

constexpr double kLamp = 60000.0;

class GlareLamps : public GlareKernelTest {
 protected:
  static GlareInput lamp_at(glm::dvec2 at_px, std::uint32_t lines = 90) {
    GlareInput in(uvec2(320, 180));
    in.lines = lines;
    in.add_lamp(at_px, kLamp);
    return in;
  }
};

// Hard case: glare.energy
TEST_F(GlareLamps, lose_no_light_wherever_they_are) {
  for (const std::uint32_t lines : {45u, 90u, 180u})
    for (const glm::dvec2 at : {glm::dvec2(160.0, 90.0), glm::dvec2(161.5, 90.5), glm::dvec2(3.25, 2.5), glm::dvec2(319.5, 179.5),
                           glm::dvec2(100.5, 0.5), glm::dvec2(0.5, 90.75)}) {
      SCOPED_TRACE(std::to_string(at.x) + ", " + std::to_string(at.y) + ", lines " + std::to_string(lines));
      const GlareInput in = lamp_at(at, lines);
      std::printf("energy %g %g %u: %.5f\n", at.x, at.y, lines, energy(run(in)) / energy(right(in)));
      EXPECT_NEAR(energy(run(in)) / energy(right(in)), 1.0, 0.02);
    }
}

// Hard case: glare.moving_lamp
TEST_F(GlareLamps, that_move_through_pixels_do_not_make_their_glow_flicker) {
  // Points of the picture, away from the lamp by one to ten cells.
  const ivec2 points[] = {{162, 88}, {164, 93}, {170, 90}, {160, 75}, {185, 110}, {120, 60}};
  for (const std::uint32_t lines : {45u, 90u, 180u}) {
    double worst_step = 0.0, worst = 0.0, low = 10, high = 0;
    std::vector<double> before;
    for (int step = 0; step <= 64; ++step) {
      const GlareInput in = lamp_at(glm::dvec2(152.5 + step / 8.0, 84.5 + step / 16.0), lines);
      const std::vector<vec4> found = run(in);
      const std::vector<dvec3> expected = right(in);
      std::vector<double> ratios;
      for (const ivec2& p : points) {
        const std::size_t i = static_cast<std::size_t>(p.y) * 320 + static_cast<std::size_t>(p.x);
        const double ratio = static_cast<double>(found[i].x) / expected[i].x;
        ratios.push_back(ratio);
        low = std::min(low, ratio); high = std::max(high, ratio);
        worst = std::max(worst, std::abs(ratio - 1.0));
        if (!before.empty()) worst_step = std::max(worst_step, std::abs(ratio / before[ratios.size() - 1] - 1.0));
      }
      before = ratios;
    }
    std::printf("lines %u: worst ratio %.4f, range %.4f %.4f step %.4f\n", lines, worst, low, high, worst_step);
  }
}

}  // namespace
}  // namespace gloam::test
