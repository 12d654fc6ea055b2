// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "modules/particles/emitters/visible.h"

namespace gloam {

/// Sort keys of one emitter: a particle at view depth d has the key first + floor((far_m − d) · keys_per_m), within
/// first … first + count − 1.
struct KeyRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  double far_m = 0.0;
  double keys_per_m = 0.0;
};

/// Keys of a sort with one pass of 8 bits, and with two. The greatest first digit stands for particles that are not
/// drawn.
inline constexpr std::uint32_t kOneDigitKeys = 0xFF, kTwoDigitKeys = 0xFF00;
/// Particles that are sorted by one digit.
inline constexpr std::uint32_t kMostOneDigitParticles = 256;

/// Divides `keys` sort keys among the emitters, far ones first. Emitters whose depths overlap share a range, so that
/// their particles are sorted as one cloud. All ranges have equal numbers of keys, at least one; the quantum of an
/// order is the length of its range's depths ÷ that number. In the order of the emitters. Needs at least as many keys
/// as emitters.
[[nodiscard]] std::vector<KeyRange> key_ranges(std::span<const VisibleEmitter> emitters, std::uint32_t keys);

}  // namespace gloam
