// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace gloam {

/// The last times of a series, and percentiles of them. Never allocates memory.
class RecentTimes {
 public:
  static constexpr std::size_t kMost = 60;

  /// Forgets the oldest time if there are kMost.
  void add(double ms);
  void clear() { size_ = 0; }
  [[nodiscard]] std::size_t size() const { return size_; }

  /// The rank-th largest of the newest `count` times. count: 1…size(). rank: 1…count.
  [[nodiscard]] double largest(std::size_t rank, std::size_t count) const;
  /// The 90th percentile of the newest `count` times (nearest rank). Of 2 to 19 times it is the second largest, so that
  /// a single spike never counts. count: 1…size().
  [[nodiscard]] double percentile_90(std::size_t count) const;

  bool operator==(const RecentTimes&) const = default;

 private:
  std::array<double, kMost> times_ = {};  ///< a ring
  std::size_t next_ = 0;
  std::size_t size_ = 0;
};

}  // namespace gloam
