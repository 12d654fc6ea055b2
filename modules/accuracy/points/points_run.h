// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "modules/accuracy/cost/default_times.h"
#include "modules/accuracy/cost/time_plan.h"
#include "modules/accuracy/cost/whole_frame.h"
#include "modules/accuracy/ledger/measurement_store.h"
#include "modules/accuracy/points/cost_model.h"

namespace gloam {

/// Measures combinations: the user's settings, the exact setting, combinations from the whole predicted front, and then
/// neighbours of the measured front.
class PointsRun {
 public:
  /// All must outlive it. rows: finished. The knobs must have the user's values.
  PointsRun(const CostRequest& request, CostSubject& subject, CostProgress& progress, WholeFrame& whole,
            DrawnSettings& drawn, TimePlan& plan, const std::vector<LedgerRow>& rows);

  /// At most request.points combinations, but always the user's settings and the exact one.
  [[nodiscard]] Status measure();
  /// The rows measured by measure(), for share_default_times().
  [[nodiscard]] KnobRows& rows() { return rows_; }
  /// After share_default_times(): the points, the fastest first.
  [[nodiscard]] std::vector<LedgerPoint> finish() const;

 private:
  struct Planned {
    Changes changes;
    Cost predicted;
  };
  [[nodiscard]] bool knows(const Changes& changes) const;
  [[nodiscard]] Status add(Changes changes);
  [[nodiscard]] Status improve_front();

  const CostRequest& request_;
  CostSubject& subject_;
  CostProgress& progress_;
  WholeFrame& whole_;
  DrawnSettings& drawn_;
  TimePlan& plan_;
  const CostModel model_;
  const MeasurementStore store_;
  Changes exact_;
  std::vector<Planned> planned_;  ///< of rows_.rows, in the same order
  KnobRows rows_;
};

/// How well the points' predictions agree with what was measured.
[[nodiscard]] ModelQuality model_quality(const std::vector<LedgerPoint>& points);

}  // namespace gloam
