// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "modules/accuracy/cost/camera_run.h"
#include "modules/accuracy/cost/default_times.h"
#include "modules/accuracy/cost/time_plan.h"
#include "modules/accuracy/ledger/measurement_store.h"
#include "modules/accuracy/points/cost_model.h"

namespace gloam {

/// Measures combinations: the user's settings, the exact setting, combinations from the whole predicted front, and then
/// neighbours of the measured front. Each is measured in all cameras.
class PointsRun {
 public:
  /// All must outlive it. cameras: at least one, finished; the knobs must have the user's values. most: combinations,
  /// but always the user's settings and the exact one. rows: the worst of the cameras.
  PointsRun(std::span<const std::unique_ptr<CameraRun>> cameras, CostProgress& progress, TimePlan& plan,
            std::size_t most, const std::vector<LedgerRow>& rows);

  [[nodiscard]] Status measure();
  /// The rows that measure() measured in a camera, for CameraRun::finish().
  [[nodiscard]] KnobRows& rows(std::size_t camera) { return rows_[camera]; }
  /// After CameraRun::finish(): the points, the fastest first.
  [[nodiscard]] std::vector<LedgerPoint> finish() const;

 private:
  struct Planned {
    Changes changes;
    Cost predicted;
  };
  [[nodiscard]] bool knows(const Changes& changes) const;
  [[nodiscard]] Status add(Changes changes);
  /// Measures it in a camera, unless the store has it. resumed: set to false if it is measured.
  [[nodiscard]] Status add_row(CameraRun& camera, const Changes& changes, KnobRows& rows, bool& resumed);
  [[nodiscard]] Status improve_front();
  /// The rows of planned_[index] in each camera.
  [[nodiscard]] std::vector<LedgerRow> rows_of(std::size_t index) const;
  [[nodiscard]] LedgerRow worst(std::size_t index) const;

  std::span<const std::unique_ptr<CameraRun>> cameras_;
  CostProgress& progress_;
  TimePlan& plan_;
  std::size_t most_ = 0;
  const KnobRegistry& knobs_;  ///< of the first camera
  const CostModel model_;
  const MeasurementStore store_;
  Changes exact_;
  std::vector<Planned> planned_;  ///< the first is the user's settings
  std::vector<KnobRows> rows_;    ///< of each camera; their rows are of planned_, in the same order
};

/// How well the points' predictions agree with what was measured.
[[nodiscard]] ModelQuality model_quality(const std::vector<LedgerPoint>& points);

}  // namespace gloam
