// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/time_left.h"

#include <cmath>
#include <utility>

namespace gloam {

void TimeLeft::plan(std::vector<std::string> kinds) {
  kinds_ = std::move(kinds);
  done_ = 0;
}

void TimeLeft::finished(std::optional<double> seconds) {
  if (done_ >= kinds_.size()) return;
  const std::string& kind = kinds_[done_++];
  if (!seconds) return;
  Times& times = times_[kind];
  times.sum_s += *seconds;
  times.count += 1.0;
}

std::optional<double> TimeLeft::seconds() const {
  if (times_.empty() || done_ >= kinds_.size()) return std::nullopt;
  Times all;
  for (const auto& [kind, times] : times_) {
    all.sum_s += times.sum_s;
    all.count += times.count;
  }
  double left_s = 0.0;
  for (std::size_t i = done_; i < kinds_.size(); ++i) {
    const auto known = times_.find(kinds_[i]);
    const Times& times = known == times_.end() ? all : known->second;
    left_s += times.sum_s / times.count;
  }
  return left_s;
}

std::string time_left_text(std::optional<double> seconds) {
  if (!seconds || *seconds < 1.0) return {};
  if (*seconds < 90.0) return ", about " + std::to_string(std::lround(*seconds)) + " s left";
  return ", about " + std::to_string(std::lround(*seconds / 60.0)) + " min left";
}

}  // namespace gloam
