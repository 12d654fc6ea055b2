// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "tests/fuzz/target.h"

namespace gloam::fuzz {

/// The rest of an input; zeros after its end.
class Source {
 public:
  explicit Source(Input input) : left_(input) {}
  [[nodiscard]] bool ended() const { return left_.empty(); }
  std::uint8_t byte() {
    if (left_.empty()) return 0;
    const std::uint8_t first = left_.front();
    left_ = left_.subspan(1);
    return first;
  }
  /// One of `count` choices; most bytes choose the first one.
  std::size_t mostly_first(std::size_t count) {
    const std::uint8_t chosen = byte();
    return chosen < 240 ? 0 : chosen % count;
  }
  /// Mostly between 0 and 12, otherwise a number at which something may end.
  double number() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr std::array kOdd = {-1.0,  -0.0,  kInfinity, -kInfinity, kNan,    3.4e38, -3.4e38,  1e300,
                                 1e-45, 1e-38, 1e-9,      16777217.0, 65504.0, 1e9,    -0.00001, 3.14159265};
    const std::uint8_t chosen = byte();
    return chosen < 240 ? chosen / 20.0 : kOdd[chosen % kOdd.size()];
  }
  float number_f() { return static_cast<float>(number()); }

 private:
  Input left_;
};

}  // namespace gloam::fuzz
