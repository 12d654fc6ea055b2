// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace gloam {

// The pair (reversed_bits(i), second_sobol(i)) is the (0, 2)-sequence of van der Corput and Sobol' (Kollig and Keller
// 2002, "Efficient Multidimensional Sampling"), as fractions of 2^32: of 2^k points from a multiple of 2^k on, each box
// of 2^-a × 2^(a-k) with its corner at a multiple of its size holds one, for every a from 0 to k. The exclusive or of
// all points with constants keeps that property (scrambling).

/// First coordinate: the radical inverse of base 2.
[[nodiscard]] constexpr std::uint32_t reversed_bits(std::uint32_t x) {
  std::uint32_t reversed = 0;
  for (int bit = 0; bit < 32; ++bit) reversed |= (x >> bit & 1u) << (31 - bit);
  return reversed;
}

/// Second coordinate: the second dimension of Sobol's sequence.
[[nodiscard]] constexpr std::uint32_t second_sobol(std::uint32_t index) {
  std::uint32_t result = 0;
  for (std::uint32_t v = 1u << 31; index != 0; index >>= 1, v ^= v >> 1)
    if ((index & 1u) != 0) result ^= v;
  return result;
}

/// A pseudorandom permutation of the 32-bit numbers that keeps 0: lowbias32 (Wellons 2018, "Prospecting for Hash
/// Functions").
[[nodiscard]] constexpr std::uint32_t permuted(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

/// The middle of the x-th of 2^32 equal parts of the unit interval: in (0, 1).
[[nodiscard]] constexpr double unit_fraction(std::uint32_t x) { return (static_cast<double>(x) + 0.5) / 4294967296.0; }

}  // namespace gloam
