// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "modules/accuracy/cost/time_plan.h"
#include "modules/accuracy/cost/timing.h"
#include "modules/accuracy/cost/whole_frame.h"
#include "modules/accuracy/ledger/row_json.h"
#include "modules/accuracy/points/cost_model.h"

namespace gloam {

/// The knobs that are not at their declared default after the changes, without those that reuses_last_frame().
[[nodiscard]] std::vector<KnobValue> settings_with(const KnobRegistry& knobs, const Changes& changes);

/// Measures one combination against the user's settings.
class PointMeasurement {
 public:
  /// All must outlive it. changes: of existing knobs to valid values. The knobs must have the user's values whenever a
  /// member is called, and have them afterwards.
  PointMeasurement(const CostRequest& request, CostSubject& subject, CostProgress& progress, WholeFrame& whole,
                   DrawnSettings& drawn, TimePlan& plan, Changes changes);

  /// Everything that the point depends on, in one line.
  [[nodiscard]] std::string identity() const;
  [[nodiscard]] Result<TimedRow> measure();

 private:
  [[nodiscard]] Status judge(LedgerRow& row);
  [[nodiscard]] Result<AlternatingTimes> time();
  [[nodiscard]] Status set(TimedSide side);

  const CostRequest& request_;
  CostSubject& subject_;
  CostProgress& progress_;
  WholeFrame& whole_;
  DrawnSettings& drawn_;
  TimePlan& plan_;
  std::vector<KnobOverride> users_;    ///< the user's values of the changed knobs
  std::vector<KnobOverride> changes_;  ///< in the same order
  std::vector<KnobValue> settings_;
};

}  // namespace gloam
