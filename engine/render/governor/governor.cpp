// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/governor/governor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/assert.h"

namespace gloam {
namespace {

// Times are kept in this range, so that no product or ratio of them is infinite or NaN.
constexpr double kLeastMs = 1e-6;
constexpr double kMostMs = 1e9;
// A longer frame counts as this long where frame times are summed: the program was stopped, or the clock has jumped.
constexpr double kLongestFrameMs = 1000.0;
// Newest frames that tell the present load: of a load that has just grown, older ones tell nothing.
constexpr std::size_t kNewest = 10;

// A front that another view and machine made is wrong by up to this factor. If frames take longer than that, the load
// has grown.
constexpr double kMostWrong = 2.0;

bool is_usable(double ms) { return std::isfinite(ms) && ms > 0.0; }

}  // namespace

std::string_view governor_reason_name(GovernorReason reason) {
  switch (reason) {
    case GovernorReason::none:
      return "none";
    case GovernorReason::over_budget:
      return "over_budget";
    case GovernorReason::step_failed:
      return "step_failed";
    case GovernorReason::fits_again:
      return "fits_again";
    case GovernorReason::budget_changed:
      return "budget_changed";
    case GovernorReason::cannot_fit:
      return "cannot_fit";
  }
  return "none";
}

Governor::Governor(std::span<const GovernorPoint> front, double budget_ms) : budget_ms_(budget_ms) {
  GLOAM_ASSERT(budget_ms > 0.0, "a budget is above 0 ms");
  points_.reserve(front.size());
  double ms = 0.0;
  double least_error = std::numeric_limits<double>::infinity();
  for (const GovernorPoint& point : front) {
    if (is_usable(point.ms)) ms = std::max(ms, std::clamp(point.ms, kLeastMs, kMostMs));
    const bool better = points_.empty() || !(point.error >= least_error);
    if (point.error < least_error) least_error = point.error;
    points_.push_back({.ms = ms, .better = better});
  }
  // Points before the first usable time count as fast as it.
  const auto first = std::find_if(points_.begin(), points_.end(), [](const Point& point) { return point.ms > 0.0; });
  const double first_ms = first == points_.end() ? 1.0 : first->ms;
  std::for_each(points_.begin(), first, [&](Point& point) { point.ms = first_ms; });
  point_ = fitting_point(1.0, points_.size());
}

void Governor::set_budget(double budget_ms) {
  GLOAM_ASSERT(budget_ms > 0.0, "a budget is above 0 ms");
  if (budget_ms == budget_ms_) return;
  budget_ms_ = budget_ms;
  budget_changed_ = true;
  said_cannot_fit_ = false;
}

double Governor::measured_ms() const { return times_.size() == 0 ? 0.0 : times_.percentile_90(times_.size()); }

double Governor::expected_ms(std::size_t point) const {
  GLOAM_ASSERT(point < points_.size(), "expected_ms() wants a point of the front");
  const double ms = points_[point].ms, measured = measured_ms();
  if (measured == 0.0) return ms;
  const double scale = measured / points_[point_].ms;
  return ms * (point > point_ ? scale_at(point, scale) : scale);
}

GovernorDecision Governor::add(const GovernorFrame& frame) {
  if (points_.empty()) return stay(GovernorReason::none, 0.0);
  const bool is_new = note_frame(frame);
  const bool budget_changed = std::exchange(budget_changed_, false);
  if (!is_new && !budget_changed) return stay(GovernorReason::none, 0.0);
  GovernorDecision decision;
  if (judged_ == 0)
    decision = start();
  else
    decision = over_budget() ? leave_for_cheaper() : try_better();
  if (budget_changed && decision.changed()) decision.reason = GovernorReason::budget_changed;
  return decision;
}

/// By the front's own times, as long as nothing has been measured.
GovernorDecision Governor::start() {
  const std::size_t target = fitting_point(1.0, points_.size());
  return move_to(target, GovernorReason::none, 0.0, points_[target].ms);
}

/// Returns whether the frame is one to judge.
bool Governor::note_frame(const GovernorFrame& frame) {
  if (started_ && frame.view != view_) {
    ++views_;
    left_.known = false;
  }
  started_ = true;
  view_ = frame.view;
  if (!is_usable(frame.ms)) return false;
  elapsed_ms_ += std::min(frame.ms, kLongestFrameMs);
  if (!frame.judged) return false;
  times_.add(std::clamp(frame.ms, kLeastMs, kMostMs));
  ++judged_;
  ++judged_here_;
  if (judged_here_ == kFramesToFit) note_reference();
  if (judged_here_ >= kSoonFrames) left_.known = false;
  if (points_[point_].step.made && !is_soon(points_[point_].step)) {
    points_[point_].step.made = false;
    for (std::size_t i = 0; i <= point_; ++i) points_[i].failure = {};
  }
  return true;
}

/// For failures since the last measurement at one point: what frames take now, after the step back.
void Governor::note_reference() {
  const double scale = times_.percentile_90(kFramesToFit) / points_[point_].ms;
  for (Point& point : points_) {
    Failure& failure = point.failure;
    if (failure.count == 0 || std::exchange(failure.measured_after, true) || scale <= failure.reference_scale) continue;
    failure.reference_scale = scale;
    failure.reference = point_;
  }
}

bool Governor::over_budget() const {
  const std::size_t count = times_.size();
  if (count < kFramesOver) return false;
  if (times_.largest(kFramesOver, kFramesOver) > budget_ms_) return true;
  return times_.largest(std::max(kFramesOver, count / 10 + 1), count) > budget_ms_;
}

bool Governor::is_soon(const StepUp& step) const {
  return judged_ - step.judged < kSoonFrames || elapsed_ms_ - step.at_ms < kSoonMs;
}

GovernorDecision Governor::leave_for_cheaper() {
  const std::size_t frames = times_.size();
  const double measured_ms = std::max(times_.percentile_90(frames), times_.percentile_90(std::min(frames, kNewest)));
  if (point_ == 0) {
    if (std::exchange(said_cannot_fit_, true)) return stay(GovernorReason::none, 0.0);
    return stay(GovernorReason::cannot_fit, measured_ms);
  }
  const double scale = measured_ms / points_[point_].ms;
  std::size_t target = fitting_point(scale, point_);
  double predicted_ms = scale * points_[target].ms;
  GovernorReason reason = GovernorReason::over_budget;
  const StepUp& step = points_[point_].step;
  // Not if the budget has been lowered since the step.
  if (step.made && is_soon(step) && measured_ms > step.budget_ms) {
    reason = GovernorReason::step_failed;
    // Either the point costs more than the front says: then the point before the step still fits. Or the load has
    // grown: then it has grown there as well. The step is taken back if half of the growth (of its logarithm) would
    // fit, but not if this point was itself come back to and should have fitted.
    const double growth = std::max(1.0, measured_ms / step.predicted_ms);
    const bool is_last_change = judged_ - judged_here_ == step.judged;
    const bool would_fit = growth <= kMostWrong && step.from_ms * std::sqrt(growth) <= budget_ms_;
    if (step.from < target || (is_last_change && would_fit && step.views == views_)) {
      target = step.from;
      predicted_ms = step.from_ms;
    }
  }
  note_departure(target, measured_ms);
  return move_to(target, reason, measured_ms, predicted_ms);
}

/// Steps up to the points above the target are taken back. Those that were made a short time ago have failed.
void Governor::note_departure(std::size_t target, double measured_ms) {
  const double scale = measured_ms / points_[point_].ms;
  left_ = {true, point_, scale};
  Point& here = points_[point_];
  here.departures = departures(here) + 1;
  here.departed_ms = elapsed_ms_;
  here.departed_views = views_;
  for (std::size_t i = target + 1; i <= point_; ++i) {
    const StepUp step = std::exchange(points_[i].step, {});
    if (!step.made || !is_soon(step) || measured_ms <= step.budget_ms) continue;
    Failure& failure = points_[i].failure;
    const std::size_t count = failure.views == step.views ? failure.count + 1 : 1;
    failure = {count,       scale,     step.from_ms / points_[step.from].ms, step.from, false, budget_ms_,
               elapsed_ms_, step.views};
  }
}

GovernorDecision Governor::try_better() {
  if (times_.size() < kFramesToFit) return stay(GovernorReason::none, 0.0);
  // The second largest of the newest four tells a load that has just grown.
  const double measured_ms = std::max(times_.percentile_90(kFramesToFit), times_.largest(2, kFramesOver));
  if (measured_ms <= kFit * budget_ms_) said_cannot_fit_ = false;
  const double scale = measured_ms / points_[point_].ms;
  std::size_t target = point_;
  double predicted_ms = measured_ms;
  double target_limit_ms = 0.0;
  double most_ms = kFit * budget_ms_;
  for (std::size_t i = point_ + 1; i < points_.size() && !is_blocked(i, scale); ++i) {
    const double ms = scale_at(i, scale) * points_[i].ms;
    most_ms = std::min(most_ms, limit_ms(i));
    if (!points_[i].better || ms > most_ms) continue;
    target = i;
    predicted_ms = ms;
    target_limit_ms = most_ms;
  }
  if (target == point_) return stay(GovernorReason::none, 0.0);
  if (predicted_ms <= kSmallStep * measured_ms) {
    if (times_.size() < RecentTimes::kMost) return stay(GovernorReason::none, 0.0);
    const double longer_ms = times_.percentile_90(RecentTimes::kMost);
    if (longer_ms * predicted_ms / measured_ms > target_limit_ms) return stay(GovernorReason::none, 0.0);
  }
  points_[target].step = {true, point_, measured_ms, predicted_ms, budget_ms_, judged_, elapsed_ms_, views_};
  left_.known = false;
  return move_to(target, GovernorReason::fits_again, measured_ms, predicted_ms);
}

bool Governor::is_remembered(const Failure& failure) const {
  return failure.count > 0 && (failure.views == views_ || elapsed_ms_ - failure.at_ms < kHoldMs);
}

/// scale: measured at the present point. Below the reference it tells nothing: cheap points may have grown less.
bool Governor::is_blocked(std::size_t point, double scale) const {
  const Failure& failure = points_[point].failure;
  if (!is_remembered(failure)) return false;
  if (point_ < failure.reference) return true;
  if (elapsed_ms_ - failure.at_ms < std::ldexp(kHoldMs, static_cast<int>(std::min<std::size_t>(failure.count, 30)) - 1))
    return true;
  return scale / budget_ms_ > kMuchCheaper * failure.reference_scale / failure.budget_ms;
}

/// The scale that was measured at a point that was left; 0 if there is none. scale: measured at the present point.
double Governor::known_scale(std::size_t point, double scale) const {
  const Failure& failure = points_[point].failure;
  if (is_remembered(failure)) return failure.scale * scale / failure.reference_scale;
  return left_.known && left_.point == point ? left_.scale : 0.0;
}

/// The scale expected at a better point, by the nearest point whose scale is known: at or above it, or else below.
/// Between the present point and the known one it is interpolated: its logarithm over that of the front's times.
double Governor::scale_at(std::size_t point, double scale) const {
  std::size_t at = point;
  while (at < points_.size() && known_scale(at, scale) == 0.0) ++at;
  if (at == points_.size()) {
    at = point;
    while (at > point_ && known_scale(at, scale) == 0.0) --at;
  }
  const double known = at > point_ ? known_scale(at, scale) : 0.0;
  if (known <= scale) return scale;  // none, or noise: better points do not grow less than cheaper ones
  const double from_ms = points_[point_].ms;
  if (at <= point || points_[at].ms <= from_ms) return known;
  return scale * std::pow(known / scale, std::log(points_[point].ms / from_ms) / std::log(points_[at].ms / from_ms));
}

std::size_t Governor::departures(const Point& point) const {
  return point.departed_views == views_ && elapsed_ms_ - point.departed_ms < kReturnMs ? point.departures : 0;
}

/// The time that a step up to a point may be predicted to take.
double Governor::limit_ms(std::size_t point) const {
  const std::size_t count = std::clamp<std::size_t>(departures(points_[point]), 1, kMostReturns + 1);
  return kFit * std::pow(kFitOfReturn, static_cast<double>(count - 1)) * budget_ms_;
}

/// The best point before `end` that fits with room to spare; 0 if none does.
std::size_t Governor::fitting_point(double scale, std::size_t end) const {
  for (std::size_t i = end; i-- > 1;)
    if (points_[i].better && scale * points_[i].ms <= kFit * budget_ms_) return i;
  return 0;
}

GovernorDecision Governor::move_to(std::size_t point, GovernorReason reason, double measured_ms, double predicted_ms) {
  const GovernorDecision decision{point_, point, reason, measured_ms, predicted_ms, budget_ms_};
  point_ = point;
  times_.clear();
  judged_here_ = 0;
  return decision;
}

GovernorDecision Governor::stay(GovernorReason reason, double measured_ms) const {
  return {point_, point_, reason, measured_ms, measured_ms, budget_ms_};
}

}  // namespace gloam
