// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

namespace gloam::test {

/// The greater error. A NaN counts as infinite: std::max would leave it out, and it compares false with every bound.
template <class Number>
[[nodiscard]] constexpr Number worse(Number worst, Number error) {
  if (error <= worst) return worst;
  return error > worst ? error : std::numeric_limits<Number>::infinity();
}

}  // namespace gloam::test
