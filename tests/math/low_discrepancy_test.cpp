// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/math/low_discrepancy.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace gloam {
namespace {

/// Number of the boxes of 2^-columns × 2^-rows that hold a point of first … first + 2^(columns + rows) - 1.
std::size_t boxes_hit(std::uint32_t first, int columns, int rows, std::uint32_t scramble_x, std::uint32_t scramble_y) {
  std::set<std::pair<std::uint64_t, std::uint64_t>> boxes;
  for (std::uint32_t i = first; i < first + (1u << (columns + rows)); ++i) {
    const std::uint64_t x = reversed_bits(i) ^ scramble_x, y = second_sobol(i) ^ scramble_y;
    boxes.insert({x << columns >> 32, y << rows >> 32});
  }
  return boxes.size();
}

TEST(LowDiscrepancy, sixteen_points_hit_each_elementary_box_once) {
  for (const std::uint32_t first : {0u, 16u, 4080u})
    for (int columns = 0; columns <= 4; ++columns) {
      EXPECT_EQ(boxes_hit(first, columns, 4 - columns, 0, 0), 16u) << first << ", " << columns;
      EXPECT_EQ(boxes_hit(first, columns, 4 - columns, permuted(1), permuted(2)), 16u) << first << ", " << columns;
    }
}

TEST(LowDiscrepancy, reversed_bits_are_their_own_inverse) {
  EXPECT_EQ(reversed_bits(1), 0x80000000u);
  EXPECT_EQ(reversed_bits(0x12345678u), 0x1e6a2c48u);
  for (std::uint32_t x = 1; x < 1000; ++x) EXPECT_EQ(reversed_bits(reversed_bits(x * 0x9e3779b9u)), x * 0x9e3779b9u);
}

/// Inverse of a multiplication with an odd factor.
std::uint32_t divided(std::uint32_t x, std::uint32_t factor) {
  std::uint32_t inverse = factor;
  for (int step = 0; step < 5; ++step) inverse *= 2 - factor * inverse;
  return x * inverse;
}

std::uint32_t permuted_back(std::uint32_t x) {
  x = divided(x ^ (x >> 16), 0x846ca68bu);
  x = divided(x ^ (x >> 15) ^ (x >> 30), 0x7feb352du);
  return x ^ (x >> 16);
}

TEST(LowDiscrepancy, permutation_has_an_inverse) {
  for (std::uint32_t x = 0; x < 1u << 16; ++x) {
    ASSERT_EQ(permuted_back(permuted(x)), x);
    ASSERT_EQ(permuted_back(permuted(~x)), ~x);
    ASSERT_EQ(permuted_back(permuted(x * 0x9e3779b9u)), x * 0x9e3779b9u);
  }
}

// Pinned: traced references in caches were made with these numbers.
TEST(LowDiscrepancy, numbers_keep_their_pinned_values) {
  EXPECT_EQ(second_sobol(1), 0x80000000u);
  EXPECT_EQ(second_sobol(2), 0xc0000000u);
  EXPECT_EQ(second_sobol(3), 0x40000000u);
  EXPECT_EQ(second_sobol(1000), 0x29400000u);
  EXPECT_EQ(permuted(0), 0u);
  EXPECT_EQ(permuted(1), 0x688990c0u);
  EXPECT_EQ(permuted(0xffffffffu), 0x6768824au);
}

TEST(LowDiscrepancy, unit_fractions_are_between_zero_and_one) {
  EXPECT_EQ(unit_fraction(0), 0x1p-33);
  EXPECT_EQ(unit_fraction(0x80000000u), 0.5 + 0x1p-33);
  EXPECT_LT(unit_fraction(0xffffffffu), 1.0);
}

}  // namespace
}  // namespace gloam
