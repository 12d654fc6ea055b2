// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "engine/render/governor/recent_times.h"

// Chooses among measured settings so that frames stay within a time budget. Numbers go in and numbers come out: there
// is no clock, no renderer and no random number here, and the same series of frames gives the same decisions.

namespace gloam {

/// A point of a front: a whole setting with the time and the error that were measured for it.
struct GovernorPoint {
  /// Milliseconds, 1e-6…1e9. Only ratios between points are used: the view and the machine may have been others. A time
  /// that is NaN, infinite, zero, negative, or below an earlier point's counts as the largest time of the earlier
  /// points.
  double ms = 0.0;
  /// Any scale on which less is better. A point whose error is not below that of all earlier points is never chosen,
  /// because a cheaper point is as right. NaN is unknown: then the order alone says that the point is more exact.
  double error = std::numeric_limits<double>::quiet_NaN();
};

/// A frame that has been drawn with Governor::point().
struct GovernorFrame {
  /// Milliseconds. Times that are NaN, infinite, zero or negative are ignored: the clock has wrapped or jumped.
  double ms = 0.0;
  /// false for frames that say nothing about the point: the first ones after a change of point, which fill histories;
  /// frames that make images or pipelines; and frames that were drawn with an earlier point, if times arrive late.
  bool judged = true;
  /// A different number than in the frame before says that other things are seen: a camera cut, a load of a scene.
  std::uint64_t view = 0;
};

enum class GovernorReason : std::uint8_t {
  none,            ///< no change
  over_budget,     ///< recent frames took longer than the budget: to a cheaper point
  step_failed,     ///< the same, soon after a step to a better point, which is taken back and not tried again
  fits_again,      ///< a better point is predicted to fit with 10 % to spare
  budget_changed,  ///< the first frame after set_budget(): to a cheaper or to a better point
  cannot_fit,  ///< the cheapest point is over the budget. No change; said once until frames fit or the budget changes
};

/// "over_budget" for GovernorReason::over_budget, and so on.
[[nodiscard]] std::string_view governor_reason_name(GovernorReason reason);

/// What to draw the next frame with, and why. A decision without a reason has no times but the budget.
struct GovernorDecision {
  std::size_t previous = 0;  ///< index of the point that the frame was drawn with
  std::size_t point = 0;     ///< index of the point for the next frame
  GovernorReason reason = GovernorReason::none;
  double measured_ms = 0.0;   ///< recent 90th percentile at `previous`; 0 if no frame was measured
  double predicted_ms = 0.0;  ///< 90th percentile expected at `point`
  double budget_ms = 0.0;
  [[nodiscard]] bool changed() const { return point != previous; }
  bool operator==(const GovernorDecision&) const = default;
};

/// The decision of the frame-time governor: a function of a front, a budget and the frames so far. A value: copies go
/// on independently. Only the constructor and copies allocate memory.
///
/// Toward cheaper it moves at once, by as many points as the prediction says, when the recent 90th percentile is over
/// the budget. Toward better it moves when the 90th percentile of the last 30 judged frames, scaled to the better
/// point, fits with 10 % to spare. Between the two it stays where it is.
///
/// A step to a better point that must be taken back soon has failed. That point and better ones are not tried again
/// until the view has changed, or until frames have become 20 % cheaper in relation to the budget. What the failure
/// has shown about the point's real cost is used to predict the points below it.
class Governor {
 public:
  /// Of the budget: the time that a point may be predicted to take if it is moved to.
  static constexpr double kFit = 0.9;
  /// Factor on kFit for a point that was over the budget and left: once for each time after the first in the present
  /// view, and at most kMostReturns times. So a point at the very limit is not entered and left for ever. Forgotten
  /// when it has not been left for kReturnMs, a sum of frame times.
  static constexpr double kFitOfReturn = 0.97;
  static constexpr std::size_t kMostReturns = 6;
  static constexpr double kReturnMs = 30000.0;
  /// Judged frames in a row that must fit before a step to a better point. One in ten may be slower.
  static constexpr std::size_t kFramesToFit = 30;
  /// A step to a better point that takes at most this factor of the time gains little: all RecentTimes::kMost frames
  /// must fit. Otherwise noise would carry the governor up a front of many points, by one point at each lucky moment.
  static constexpr double kSmallStep = 1.1;
  /// Judged frames over the budget before a step to a cheaper point, if they follow one another. Otherwise more than
  /// one in ten of the last RecentTimes::kMost must be over, and at least as many as this.
  static constexpr std::size_t kFramesOver = 4;
  /// A step that is taken back before both have passed has failed: judged frames, and the sum of frame times.
  static constexpr std::size_t kSoonFrames = 60;
  static constexpr double kSoonMs = 2000.0;
  /// A failed step is tried again in the same view if the time in relation to the budget has fallen to this share.
  static constexpr double kMuchCheaper = 0.8;
  /// Least sum of frame times before a failed step is tried again, for whatever reason: views may change every frame.
  /// Doubles with each failure in one view.
  static constexpr double kHoldMs = 2000.0;

  /// front: points sorted from fastest to most exact; may be empty, then every decision is point 0 without a reason.
  /// budget_ms: as for set_budget(). Starts with the best point that fits by the front's own times.
  Governor(std::span<const GovernorPoint> front, double budget_ms);

  /// Takes effect with the next frame that is added. budget_ms: of a frame, > 0; infinity for no limit.
  void set_budget(double budget_ms);
  [[nodiscard]] double budget_ms() const { return budget_ms_; }
  /// Index of the point that the next frame is to be drawn with; 0 for an empty front.
  [[nodiscard]] std::size_t point() const { return point_; }
  /// 90th percentile of the last frames that were judged at point(); 0 if there are none.
  [[nodiscard]] double measured_ms() const;
  /// The 90th percentile to expect at a point of the front by these frames; without any, the front's own time.
  [[nodiscard]] double expected_ms(std::size_t point) const;
  /// Adds a frame that was drawn with point() and decides about the next one.
  GovernorDecision add(const GovernorFrame& frame);

  bool operator==(const Governor&) const = default;

 private:
  /// A step up to a point.
  struct StepUp {
    bool made = false;  ///< and neither held nor taken back
    std::size_t from = 0;
    double from_ms = 0.0;       ///< 90th percentile at `from`
    double predicted_ms = 0.0;  ///< at the point
    double budget_ms = 0.0;
    std::uint64_t judged = 0;  ///< judged_, elapsed_ms_ and views_ when it was made
    double at_ms = 0.0;
    std::uint64_t views = 0;
    bool operator==(const StepUp&) const = default;
  };
  /// What failed steps up to a point have shown. A scale is a 90th percentile divided by the front's time of the point.
  struct Failure {
    std::size_t count = 0;  ///< in one view
    double scale = 0.0;     ///< measured at the point when the last one failed
    /// Measured at a cheaper point, `reference`, about when it failed: before the step, or after it if that is more.
    double reference_scale = 0.0;
    std::size_t reference = 0;
    bool measured_after = false;
    double budget_ms = 0.0;  ///< when it failed
    double at_ms = 0.0;      ///< elapsed_ms_ when it failed
    std::uint64_t views = 0;
    bool operator==(const Failure&) const = default;
  };
  struct Point {
    double ms = 1.0;
    bool better = true;  ///< than all earlier points
    StepUp step;
    Failure failure;
    std::size_t departures = 0;  ///< because it was over the budget
    double departed_ms = 0.0;    ///< elapsed_ms_ and views_ at the last one
    std::uint64_t departed_views = 0;
    bool operator==(const Point&) const = default;
  };
  /// The point that was left because it was over budget. Until the next step up it says, together with the present
  /// point, how the load grows along the front.
  struct LeftPoint {
    bool known = false;
    std::size_t point = 0;
    double scale = 0.0;
    bool operator==(const LeftPoint&) const = default;
  };

  bool note_frame(const GovernorFrame& frame);
  void note_reference();
  void note_departure(std::size_t target, double measured_ms);
  [[nodiscard]] bool over_budget() const;
  [[nodiscard]] bool is_soon(const StepUp& step) const;
  [[nodiscard]] bool is_remembered(const Failure& failure) const;
  [[nodiscard]] bool is_blocked(std::size_t point, double scale) const;
  [[nodiscard]] double known_scale(std::size_t point, double scale) const;
  [[nodiscard]] double scale_at(std::size_t point, double scale) const;
  [[nodiscard]] std::size_t departures(const Point& point) const;
  [[nodiscard]] double limit_ms(std::size_t point) const;
  [[nodiscard]] std::size_t fitting_point(double scale, std::size_t end) const;
  GovernorDecision start();
  GovernorDecision leave_for_cheaper();
  GovernorDecision try_better();
  GovernorDecision move_to(std::size_t point, GovernorReason reason, double measured_ms, double predicted_ms);
  [[nodiscard]] GovernorDecision stay(GovernorReason reason, double measured_ms) const;

  std::vector<Point> points_;
  double budget_ms_;
  std::size_t point_ = 0;
  RecentTimes times_;              ///< of judged frames since the last change of point
  std::uint64_t judged_here_ = 0;  ///< judged frames since the last change of point
  std::uint64_t judged_ = 0;       ///< all judged frames
  double elapsed_ms_ = 0.0;        ///< sum of all usable frame times
  std::uint64_t view_ = 0;         ///< of the last frame
  std::uint64_t views_ = 0;        ///< changes of the view so far
  bool started_ = false;           ///< a frame has been added
  bool budget_changed_ = false;    ///< since the last frame
  bool said_cannot_fit_ = false;   ///< and no frames have fitted since
  LeftPoint left_;
};

}  // namespace gloam
