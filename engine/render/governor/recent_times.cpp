// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/governor/recent_times.h"

#include <algorithm>
#include <functional>

#include "engine/core/assert.h"

namespace gloam {

void RecentTimes::add(double ms) {
  times_[next_] = ms;
  next_ = (next_ + 1) % kMost;
  size_ = std::min(size_ + 1, kMost);
}

double RecentTimes::largest(std::size_t rank, std::size_t count) const {
  GLOAM_ASSERT(count >= 1 && count <= size_, "there are as many times as are asked for");
  GLOAM_ASSERT(rank >= 1 && rank <= count, "a rank is 1 to the number of times");
  std::array<double, kMost> sorted;
  for (std::size_t i = 0; i < count; ++i) sorted[i] = times_[(next_ + kMost - 1 - i) % kMost];
  const auto nth = sorted.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::nth_element(sorted.begin(), nth, sorted.begin() + static_cast<std::ptrdiff_t>(count), std::greater<>());
  return *nth;
}

double RecentTimes::percentile_90(std::size_t count) const {
  const std::size_t rank = count / 10 + 1;
  return largest(std::min(std::max<std::size_t>(rank, 2), count), count);
}

}  // namespace gloam
