// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace gloam {

/// Random numbers of one blade, drawn from the surface's seed and the blade's number, so that they do not depend on the
/// order in which blades are made. The mixing function is SplitMix64's (Steele, Lea, Flood, "Fast Splittable
/// Pseudorandom Number Generators", OOPSLA 2014).
class BladeRandom {
 public:
  /// purpose: different ones give independent sequences.
  BladeRandom(std::uint32_t seed, std::uint32_t blade, std::uint32_t purpose)
      : state_(mix((std::uint64_t{seed} << 32 | blade) ^ mix(purpose + kStep))) {}

  /// Uniform in [0, 1).
  [[nodiscard]] double unit() {
    state_ += kStep;
    return static_cast<double>(mix(state_) >> 11) * 0x1p-53;
  }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15ull;
  static std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
  }

  std::uint64_t state_;
};

}  // namespace gloam
