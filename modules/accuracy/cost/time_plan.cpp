// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/time_plan.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace gloam {

TimePlan::TimePlan(double total_s, std::function<double()> clock)
    : total_s_(total_s), clock_(std::move(clock)), start_s_(clock_()) {}

TimePlan::TimePlan(double total_s)
    : TimePlan(total_s, [] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
      }) {}

void TimePlan::begin_row(std::size_t left, std::size_t timed) {
  left_ = std::max<std::size_t>(left, 1);
  left_timed_ = std::max<std::size_t>(timed, 1);
  row_s_ = clock_();
  pairs_s_ = 0.0;
}

std::function<bool()> TimePlan::begin_timing(std::size_t rows) {
  timing_s_ = clock_();
  if (total_s_ <= 0.0) return nullptr;
  return [this, end_s = timing_s_ + static_cast<double>(rows) * share_s()] { return clock_() >= end_s; };
}

void TimePlan::end_timing() { pairs_s_ = clock_() - timing_s_; }

void TimePlan::end_row() {
  other_s_ += clock_() - row_s_ - pairs_s_;
  ++rows_;
}

double TimePlan::share_s() const {
  const double left_s = total_s_ - (timing_s_ - start_s_);
  // The first row draws references that many rows share, so that its own work says little.
  const double other_s = rows_ > 0 ? other_s_ / static_cast<double>(rows_) : 0.0;
  return std::max(left_s - other_s * static_cast<double>(left_), 0.0) / static_cast<double>(left_timed_);
}

}  // namespace gloam
