// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/outputs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gloam {
namespace {

TEST(ShadowsOutputs, visibility_is_rounded_to_the_nearest_step) {
  for (const std::uint32_t levels : {15u, 255u})
    for (int i = 0; i <= 10000; ++i) {
      const float v = static_cast<float>(i) / 10000.0f;
      const float q = quantised_visibility(v, levels);
      EXPECT_LE(std::abs(q - v), 0.5f / static_cast<float>(levels) + 1e-6f);
      EXPECT_NEAR(q * static_cast<float>(levels), std::round(q * static_cast<float>(levels)), 1e-4f);
    }
}

TEST(ShadowsOutputs, almost_lit_and_almost_dark_are_so) {
  for (const std::uint32_t levels : {0u, 15u, 255u}) {
    EXPECT_EQ(quantised_visibility(0.99995f, levels), 1.0f);
    EXPECT_EQ(quantised_visibility(0.00005f, levels), 0.0f);
    EXPECT_EQ(quantised_visibility(2.0f, levels), 1.0f);
    EXPECT_EQ(quantised_visibility(-1.0f, levels), 0.0f);
    EXPECT_EQ(quantised_visibility(std::numeric_limits<float>::quiet_NaN(), levels), 0.0f);
  }
}

TEST(ShadowsOutputs, without_levels_visibility_stays_as_it_is) { EXPECT_EQ(quantised_visibility(0.3217f, 0), 0.3217f); }

}  // namespace
}  // namespace gloam
