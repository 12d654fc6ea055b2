// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <string>

#include "modules/accuracy/module.h"

namespace gloam {

/// Sums the time on the wall of each kind of work of a ledger.
class WorkTimes {
 public:
  using Clock = std::chrono::steady_clock;
  /// now: the clock.
  explicit WorkTimes(std::function<Clock::time_point()> now = &Clock::now);

  /// Work of another kind begins.
  void begin(CostPhase phase);
  /// "measuring took 512 s: timing 301 s, pictures 100 s, …\n", the longest first, without those below 1 s.
  [[nodiscard]] std::string text();

 private:
  std::function<Clock::time_point()> now_;
  CostPhase phase_ = CostPhase::other;
  Clock::time_point begin_;
  std::array<double, kCostPhases> seconds_{};
};

}  // namespace gloam
