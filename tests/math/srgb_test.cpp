// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/math/srgb.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gloam {
namespace {

/// The definition of IEC 61966-2-1, computed with exp and log in long double.
long double decoded_by_definition(long double srgb) {
  if (srgb <= 0.04045L) return srgb / 12.92L;
  return std::exp(2.4L * std::log((srgb + 0.055L) / 1.055L));
}

long double encoded_by_definition(long double linear) {
  if (linear <= 0.0031308L) return 12.92L * linear;
  return 1.055L * std::exp(std::log(linear) / 2.4L) - 0.055L;
}

// In float the rounded constants alone change results by up to 2.4 · 2^-24 of their value.
TEST(Srgb, both_precisions_are_the_definition) {
  for (int i = 0; i <= 65535; ++i) {
    const double value = i / 65535.0;
    const auto rounded = static_cast<float>(value);
    ASSERT_NEAR(srgb_to_linear(value), static_cast<double>(decoded_by_definition(value)), 1e-15) << value;
    ASSERT_NEAR(linear_to_srgb(value), static_cast<double>(encoded_by_definition(value)), 1e-15) << value;
    ASSERT_NEAR(srgb_to_linear(rounded), static_cast<float>(decoded_by_definition(rounded)), 5e-7f) << value;
    ASSERT_NEAR(linear_to_srgb(rounded), static_cast<float>(encoded_by_definition(rounded)), 5e-7f) << value;
  }
}

TEST(Srgb, known_values) {
  EXPECT_EQ(srgb_to_linear(0.0f), 0.0f);
  EXPECT_EQ(linear_to_srgb(0.0f), 0.0f);
  EXPECT_EQ(srgb_to_linear(0.0), 0.0);
  EXPECT_EQ(linear_to_srgb(0.0), 0.0);
  EXPECT_NEAR(srgb_to_linear(1.0), 1.0, 1e-15);
  EXPECT_NEAR(linear_to_srgb(1.0), 1.0, 1e-15);
  EXPECT_NEAR(srgb_to_linear(0.5), 0.21404114048223255, 1e-15);
  EXPECT_NEAR(linear_to_srgb(0.18), 0.46135612950044163, 1e-15);
  EXPECT_EQ(srgb_to_linear(0.04f), 0.04f / 12.92f);
}

TEST(Srgb, the_two_directions_undo_each_other) {
  for (int i = 0; i <= 4095; ++i) {
    const float value = static_cast<float>(i) / 4095.0f;
    ASSERT_NEAR(linear_to_srgb(srgb_to_linear(value)), value, 2e-6f);
    ASSERT_NEAR(srgb_to_linear(linear_to_srgb(value)), value, 2e-6f);
  }
}

TEST(Srgb, all_bytes_survive_and_rise) {
  float last = -1.0f;
  for (int i = 0; i <= 255; ++i) {
    const float linear = srgb_to_linear(static_cast<float>(i) / 255.0f);
    ASSERT_GT(linear, last);
    ASSERT_EQ(std::lround(linear_to_srgb(linear) * 255.0f), i);
    ASSERT_EQ(std::lround(linear_to_srgb(srgb_to_linear(i / 255.0)) * 255.0), i);
    last = linear;
  }
}

}  // namespace
}  // namespace gloam
