// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/math/srgb.h"
#include "engine/math/types.h"
#include "engine/render/kernel_check/engine_checks.h"
#include "engine/render/kernel_check/srgb_run.h"
#include "tests/support/kernel.h"

namespace gloam {
namespace {

class SrgbKernel : public test::KernelTest {
 protected:
  void run(const std::vector<vec3>& values) {
    const SrgbCurves curves = test::value_of(run_srgb(KernelLab(device(), test::gpu_log()), values));
    encoded = curves.encoded;
    decoded = curves.decoded;
    slopes = curves.slopes;
  }

  std::vector<vec3> encoded, decoded, slopes;
};

TEST_F(SrgbKernel, curves_are_those_of_the_cpu_in_double) { expect_holds({srgb_check()}); }

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
