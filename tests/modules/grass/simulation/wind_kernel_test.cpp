// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "modules/grass/simulation/wind.h"
#include "shaders/grass_test/shaders.h"
#include "tests/support/kernel.h"

namespace gloam::test {
namespace {

class GrassWindKernel : public KernelTest {};

TEST_F(GrassWindKernel, is_the_wind_of_the_twin) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(-10.0f, 270.0f);
  std::vector<vec4> points;
  for (int i = 0; i < 4096; ++i) points.push_back({place(random), place(random), place(random), 0.0f});
  points[0] = vec4(0.0f);
  points[1] = vec4(256.0f);
  points[2] = vec4(8.0f, 0.0f, 16.0f, 0.0f);
  for (const Wind& wind : {Wind{vec3(5.0f, 1.0f, -2.0f), 0.6f}, Wind{vec3(0.0f), 1.0f},
                           Wind{vec3(0.0f, 9.0f, 0.0f), 1.0f}, Wind{vec3(1000.0f, 0.0f, 0.0f), 1.0f}}) {
    const shaders::GrassWind row = to_shader(wind_at_step(&wind, 12345, 1.0 / 120.0));
    const WindField field = from_shader(row);
    Kernel kernel(device(), shaders::grass_test::wind_comp);
    kernel.input(0, std::vector<shaders::GrassWind>{row});
    kernel.input(1, points);
    kernel.output(2, points.size() * sizeof(vec4));
    kernel.run(static_cast<std::uint32_t>(points.size() / 64));
    const std::vector<vec4> found = kernel.read<vec4>(2);
    const double speed = glm::length(field.velocity);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const dvec3 expected = wind_velocity(field, dvec3(points[i]));
      EXPECT_LE(glm::length(dvec3(found[i]) - expected), 1e-4 * speed) << i;
    }
  }
}

}  // namespace
}  // namespace gloam::test
