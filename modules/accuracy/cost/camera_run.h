// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "modules/accuracy/cost/default_times.h"
#include "modules/accuracy/cost/drawn_settings.h"
#include "modules/accuracy/cost/knob_measurement.h"
#include "modules/accuracy/cost/time_plan.h"
#include "modules/accuracy/cost/whole_frame.h"
#include "modules/accuracy/ledger/measurement_store.h"
#include "modules/accuracy/module.h"

namespace gloam {

/// The rows of one camera: measured, or found in the store.
class CameraRun {
 public:
  /// All must outlive it. seconds: for the rows, 0: no limit. points: combinations that are measured after them and
  /// share that time.
  CameraRun(const CostRequest& request, CostSubject& subject, CostProgress& progress, double seconds,
            std::size_t points);

  /// Measures all values of a knob.
  [[nodiscard]] Status measure(const std::string& name);
  /// The rows, with fronts. All rows of the default have one time, and with `others`, theirs is the same.
  [[nodiscard]] std::vector<LedgerRow> finish(KnobRows* others = nullptr);

  [[nodiscard]] const CostRequest& request() const { return request_; }
  [[nodiscard]] CostSubject& subject() const { return subject_; }
  [[nodiscard]] WholeFrame& whole() { return whole_; }
  [[nodiscard]] DrawnSettings& settings() { return settings_; }

 private:
  /// A row that is finished as soon as those before it are.
  struct WaitingRow {
    TimedRow row;
    std::string identity;
    bool resumed = false;
    bool needs_times = false;
  };
  [[nodiscard]] const Knob& knob(const std::string& name) const;
  [[nodiscard]] std::vector<PlannedRow> planned_rows() const;
  [[nodiscard]] Status add(KnobMeasurement& measurement, const std::string& name, const std::string& value,
                           std::vector<WaitingRow>& waiting);
  /// Times the rows that need it, and moves all to `rows`.
  [[nodiscard]] Status finish_rows(KnobMeasurement& measurement, std::vector<WaitingRow>& waiting, KnobRows& rows);
  /// Gives the first row of a knob the times of the default alone.
  [[nodiscard]] Status time_default(KnobMeasurement& measurement, TimedRow& first);

  const CostRequest& request_;
  CostSubject& subject_;
  CostProgress& progress_;
  const MeasurementStore store_;
  const MeasurementStore default_times_;  ///< rows of defaults that were timed alone
  DrawnSettings settings_;
  WholeFrame whole_;
  bool users_timed_ = false;  ///< a row has frames of the user's settings, which give all rows of them their time
  TimePlan plan_;
  std::size_t points_ = 0;
  std::size_t left_timed_ = 0;  ///< rows that are not finished, without those of defaults
  std::size_t done_ = 0;
  std::size_t total_ = 0;
  std::vector<KnobRows> knobs_;
};

/// Whether all pictures of a stored row are there.
[[nodiscard]] bool has_pictures(const LedgerRow& row, CostProgress& progress);

}  // namespace gloam
