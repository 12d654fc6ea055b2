// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/math/packing.h"
#include "tests/support/worse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace gloam {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::uint16_t kHalfInfinity = 0x7c00;

double angle_degrees(vec3 a, vec3 b) {
  const dvec3 x = glm::normalize(dvec3(a));
  const dvec3 y = glm::normalize(dvec3(b));
  return std::atan2(glm::length(glm::cross(x, y)), glm::dot(x, y)) * 180.0 / 3.14159265358979323846;
}

/// Directions spread evenly over the sphere, plus axes (poles included), octant seams and octant centres.
std::vector<vec3> directions() {
  std::vector<vec3> all;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / kCount;
    const double across = std::sqrt(1.0 - z * z);
    all.push_back(vec3(dvec3(across * std::cos(i * 2.4), across * std::sin(i * 2.4), z)));
  }
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) all.push_back(glm::normalize(vec3(x, y, z)));
      }
    }
  }
  return all;
}

TEST(Octahedral, codes_stay_in_the_square_and_decode_to_the_same_direction) {
  for (const vec3 direction : directions()) {
    const vec2 code = octahedral_encode(direction);
    ASSERT_LE(std::abs(code.x), 1.0f);
    ASSERT_LE(std::abs(code.y), 1.0f);
    ASSERT_LT(angle_degrees(octahedral_decode(code), direction), 1e-4);
    ASSERT_NEAR(glm::length(octahedral_decode(code)), 1.0f, 1e-6f);
  }
}

TEST(Octahedral, known_codes) {
  EXPECT_EQ(octahedral_encode(vec3(0.0f, 0.0f, 1.0f)), vec2(0.0f, 0.0f));
  EXPECT_EQ(octahedral_encode(vec3(0.0f, 0.0f, -1.0f)), vec2(1.0f, 1.0f));
  EXPECT_EQ(octahedral_encode(vec3(1.0f, 0.0f, 0.0f)), vec2(1.0f, 0.0f));
  EXPECT_EQ(octahedral_encode(vec3(0.0f, -1.0f, 0.0f)), vec2(0.0f, -1.0f));
}

TEST(Octahedral, the_zero_vector_codes_as_plus_z) {
  EXPECT_EQ(octahedral_decode(octahedral_encode(vec3(0.0f))), vec3(0.0f, 0.0f, 1.0f));
  EXPECT_EQ(unpack_normal_snorm16(pack_normal_snorm16(vec3(0.0f))), vec3(0.0f, 0.0f, 1.0f));
}

TEST(PackedNormals, are_within_a_hundredth_of_a_degree) {
  double worst = 0.0;
  for (const vec3 direction : directions()) {
    worst = test::worse(worst, angle_degrees(unpack_normal_snorm16(pack_normal_snorm16(direction)), direction));
  }
  EXPECT_LT(worst, 0.01);
}

TEST(PackedNormals, hold_x_in_the_low_half) {
  EXPECT_EQ(pack_normal_snorm16(vec3(1.0f, 0.0f, 0.0f)), 0x00007fffu);
  EXPECT_EQ(pack_normal_snorm16(vec3(0.0f, -1.0f, 0.0f)), 0x80010000u);
}

TEST(PackedNormals, packing_an_unpacked_normal_is_stable) {
  for (const vec3 direction : directions()) {
    const vec3 once = unpack_normal_snorm16(pack_normal_snorm16(direction));
    ASSERT_LT(angle_degrees(unpack_normal_snorm16(pack_normal_snorm16(once)), once), 1e-4);
  }
}

TEST(PackedNormals, no_number_packs_to_something) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(pack_normal_snorm16(vec3(nan)), 0u);
}

TEST(Half, every_half_survives_the_way_to_float_and_back) {
  for (std::uint32_t bits = 0; bits <= 0xffffu; ++bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    const bool nan = (bits & 0x7fffu) > kHalfInfinity;
    // A signalling NaN is returned as a quiet one.
    ASSERT_EQ(float_to_half(half_to_float(half)), nan ? (half | 0x0200u) : half) << bits;
  }
}

TEST(Half, values_are_those_of_the_format) {
  for (std::uint32_t bits = 0; bits < kHalfInfinity; ++bits) {
    const int exponent = static_cast<int>(bits >> 10);
    const double mantissa = bits & 0x3ffu;
    const double expected = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024.0 + mantissa, exponent - 25);
    ASSERT_EQ(half_to_float(static_cast<std::uint16_t>(bits)), expected) << bits;
    ASSERT_EQ(half_to_float(static_cast<std::uint16_t>(bits | 0x8000u)), -expected) << bits;
  }
  EXPECT_EQ(half_to_float(0x7c00), kInfinity);
  EXPECT_EQ(half_to_float(0xfc00), -kInfinity);
  EXPECT_TRUE(std::isnan(half_to_float(0x7e01)));
  EXPECT_TRUE(std::signbit(half_to_float(0x8000)));
}

TEST(Half, rounds_to_the_nearest_and_ties_to_even) {
  // Tests the midpoint of every two neighbouring halves; 2¹⁶ stands for the value above the greatest half.
  for (std::uint32_t bits = 0; bits < kHalfInfinity; ++bits) {
    const auto low = static_cast<std::uint16_t>(bits);
    const auto high = static_cast<std::uint16_t>(bits + 1);
    const double above = high == kHalfInfinity ? 65536.0 : half_to_float(high);
    const auto middle = static_cast<float>(0.5 * (half_to_float(low) + above));  // exact
    ASSERT_EQ(float_to_half(middle), (bits & 1u) == 0 ? low : high) << bits;
    ASSERT_EQ(float_to_half(std::nextafter(middle, 0.0f)), low) << bits;
    ASSERT_EQ(float_to_half(std::nextafter(middle, kInfinity)), high) << bits;
    ASSERT_EQ(float_to_half(-middle), 0x8000u | ((bits & 1u) == 0 ? low : high)) << bits;
  }
}

TEST(Half, overflow_is_infinity_and_underflow_a_signed_zero) {
  EXPECT_EQ(float_to_half(65519.996f), 0x7bff);
  EXPECT_EQ(float_to_half(65520.0f), kHalfInfinity);
  EXPECT_EQ(float_to_half(std::numeric_limits<float>::max()), kHalfInfinity);
  EXPECT_EQ(float_to_half(-kInfinity), 0xfc00);
  EXPECT_EQ(float_to_half(std::numeric_limits<float>::denorm_min()), 0x0000);
  EXPECT_EQ(float_to_half(-std::numeric_limits<float>::min()), 0x8000);
}

TEST(Half, a_nan_stays_one_with_its_sign_and_upper_payload) {
  EXPECT_EQ(float_to_half(std::bit_cast<float>(0xffc02000u)), 0xfe01);
  // A NaN whose payload is in the lower bits only must not become infinity.
  EXPECT_EQ(float_to_half(std::bit_cast<float>(0x7f800001u)), 0x7e00);
}

}  // namespace
}  // namespace gloam
