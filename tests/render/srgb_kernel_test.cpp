// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/math/srgb.h"
#include "engine/math/types.h"
#include "shaders/gpu_test/shaders.h"
#include "tests/support/kernel.h"

namespace gloam {
namespace {

/// Three channels of 0 … 1 in steps of 1/1020, which include all codes of 8 bits, and the ends of the linear parts.
std::vector<vec3> srgb_values() {
  std::vector<float> channels = {0.0031307f, 0.0031308f, 0.0031309f, 0.04044f, 0.04045f, 0.04046f};
  for (int i = 0; i <= 1020; ++i) channels.push_back(static_cast<float>(i / 1020.0));
  std::vector<vec3> values;
  for (std::size_t i = 0; i < channels.size(); ++i)
    values.emplace_back(channels[i], channels[(i + 1) % channels.size()], channels[channels.size() - 1 - i]);
  return values;
}

class SrgbKernel : public test::KernelTest {
 protected:
  void run(const std::vector<vec3>& values) {
    test::Kernel kernel(device(), shaders::gpu_test::srgb_comp);
    kernel.input(0, values);
    for (const std::uint32_t binding : {1u, 2u, 3u}) kernel.output(binding, values.size() * sizeof(vec3));
    kernel.run(static_cast<std::uint32_t>((values.size() + 63) / 64));
    encoded = kernel.read<vec3>(1);
    decoded = kernel.read<vec3>(2);
    slopes = kernel.read<vec3>(3);
  }

  std::vector<vec3> encoded, decoded, slopes;
};

TEST_F(SrgbKernel, curves_are_those_of_the_cpu_in_double) {
  const std::vector<vec3> values = srgb_values();
  run(values);
  // The driver's pow has a relative error of a few 1e-6.
  constexpr double kBound = 1e-5;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const auto value = static_cast<double>(values[i][c]);
      ASSERT_NEAR(static_cast<double>(encoded[i][c]), linear_to_srgb(value), kBound) << value;
      ASSERT_NEAR(static_cast<double>(decoded[i][c]), srgb_to_linear(value), kBound) << value;
    }
}

TEST_F(SrgbKernel, encoding_clamps_to_0_and_1) {
  run({vec3(-1.0f, 0.0f, 1.0f), vec3(2.0f, 1e30f, -1e30f)});
  EXPECT_EQ(encoded[0].x, 0.0f);
  EXPECT_EQ(encoded[0].y, 0.0f);
  EXPECT_NEAR(encoded[0].z, 1.0f, 1e-6f);
  EXPECT_NEAR(encoded[1].x, 1.0f, 1e-6f);
  EXPECT_NEAR(encoded[1].y, 1.0f, 1e-6f);
  EXPECT_EQ(encoded[1].z, 0.0f);
}

TEST_F(SrgbKernel, the_slope_is_the_derivative_of_decoding) {
  const std::vector<vec3> values = srgb_values();
  run(values);
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const auto value = static_cast<double>(values[i][c]);
      if (std::abs(value - 0.04045) < 1e-4) continue;  // the curve has a small kink there
      const double low = std::max(value - 1e-5, 0.0), high = value + 1e-5;
      const double slope = (srgb_to_linear(high) - srgb_to_linear(low)) / (high - low);
      ASSERT_NEAR(static_cast<double>(slopes[i][c]), slope, 1e-4) << value;
    }
}

}  // namespace
}  // namespace gloam
