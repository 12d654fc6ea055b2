// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gloam {

/// Estimates how long the remaining items of a run take, from the items done so far. An item's kind says which others
/// take about as long.
class TimeLeft {
 public:
  /// Kinds of all items, in order. Forgets the items of an earlier plan, not their times.
  void plan(std::vector<std::string> kinds);
  /// The next item is done. None: it took no time, because its result was there already.
  void finished(std::optional<double> seconds);
  /// Items of a kind that has no times yet get the mean of all. nullopt: no item has a time yet, or none is left.
  [[nodiscard]] std::optional<double> seconds() const;

 private:
  struct Times {
    double sum_s = 0.0;
    double count = 0.0;
  };
  std::vector<std::string> kinds_;
  std::size_t done_ = 0;
  std::map<std::string, Times> times_;
};

/// ", about 20 s left", in minutes from 90 s on; empty below 1 s and for nullopt.
[[nodiscard]] std::string time_left_text(std::optional<double> seconds);

}  // namespace gloam
