// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "modules/lighting/display/tone_reference.h"

namespace gloam {
namespace {

TEST(Dither, keeps_black_and_white) {
  for (std::uint32_t y = 0; y < 256; ++y)
    for (std::uint32_t x = 0; x < 256; ++x)
      for (std::uint32_t channel = 0; channel < 3; ++channel) {
        ASSERT_EQ(dithered_step(0.0, uvec2(x, y), channel), 0);
        ASSERT_EQ(dithered_step(1.0, uvec2(x, y), channel), 255);
      }
}

TEST(Dither, stays_within_a_step_and_a_half_and_keeps_the_mean) {
  for (const double steps : {0.1, 0.49, 0.51, 1.0, 1.3, 20.5, 127.75, 253.9, 254.4, 254.6, 254.95})
    for (std::uint32_t channel = 0; channel < 3; ++channel) {
      double sum = 0.0;
      for (std::uint32_t y = 0; y < 64; ++y)
        for (std::uint32_t x = 0; x < 64; ++x) {
          const double shown = dithered_step(steps / 255.0, uvec2(x, y), channel);
          ASSERT_LT(std::abs(shown - steps), 1.5);
          sum += shown;
        }
      EXPECT_NEAR(sum / 4096.0, steps, 0.005) << "channel " << channel;
    }
}

TEST(Dither, keeps_the_mean_of_small_squares) {
  for (double steps = 3.0; steps < 4.0; steps += 0.0625)
    for (std::uint32_t corner = 0; corner < 1000; corner += 37) {
      double sum = 0.0;
      for (std::uint32_t i = 0; i < 64; ++i)
        sum += dithered_step(steps / 255.0, uvec2(corner + i % 8, 3 * corner + i / 8), 1);
      EXPECT_NEAR(sum / 64.0, steps, 0.1) << "at " << corner;
    }
}

}  // namespace
}  // namespace gloam
