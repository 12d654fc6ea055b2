// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/math/types.h"

namespace gloam {

/// Evenly spread points on the unit disc: the (0, 2)-sequence of van der Corput and Sobol', scrambled, mapped by area
/// (Shirley and Chiu 1997). Any power of two of leading points is stratified, so half of the samples gives a coarser
/// estimate of the same value. A hash of pixel and light selects and rotates the pattern, so that errors of
/// neighbouring pixels are not correlated. Deterministic.
class EmitterSamples {
 public:
  explicit EmitterSamples(std::uint32_t count);  ///< count: ≥ 1

  [[nodiscard]] std::uint32_t count() const { return count_; }
  /// `count` points of the unit disc; point(i) rotates them by `turn`.
  struct Pattern {
    std::span<const vec2> points;
    vec2 turn = vec2(1.0f, 0.0f);  ///< cosine and sine

    [[nodiscard]] vec2 point(std::size_t i) const {
      const vec2 p = points[i];
      return {turn.x * p.x - turn.y * p.y, turn.y * p.x + turn.x * p.y};
    }
  };
  /// The pattern for a pixel and a light. Valid while this object lives.
  [[nodiscard]] Pattern pattern(std::uint32_t pixel, std::uint32_t light) const;

 private:
  static constexpr std::uint32_t kPatterns = 64;
  std::uint32_t count_;
  std::vector<vec2> points_;  ///< pattern after pattern
};

}  // namespace gloam
