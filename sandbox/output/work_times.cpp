// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/work_times.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/core/text/formatted.h"

namespace gloam {

WorkTimes::WorkTimes(std::function<Clock::time_point()> now) : now_(std::move(now)), begin_(now_()) {}

void WorkTimes::begin(CostPhase phase) {
  const Clock::time_point now = now_();
  seconds_.at(static_cast<std::size_t>(phase_)) += std::chrono::duration<double>(now - begin_).count();
  phase_ = phase;
  begin_ = now;
}

std::string WorkTimes::text() {
  begin(phase_);
  std::vector<std::pair<double, CostPhase>> parts;
  double sum_s = 0.0;
  for (std::size_t i = 0; i < seconds_.size(); ++i) {
    sum_s += seconds_[i];
    if (seconds_[i] >= 1.0) parts.emplace_back(seconds_[i], static_cast<CostPhase>(i));
  }
  std::ranges::stable_sort(parts, std::ranges::greater(), [](const auto& part) { return part.first; });
  std::string text = formatted("measuring took %.0f s", sum_s);
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? ": " : ", ") + std::string(name_of(parts[i].second)) + formatted(" %.0f s", parts[i].first);
  return text + "\n";
}

}  // namespace gloam
