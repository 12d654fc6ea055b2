// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "engine/core/assert.h"
#include "modules/accuracy/cost/default_times.h"
#include "modules/accuracy/cost/drawn_settings.h"
#include "modules/accuracy/cost/knob_measurement.h"
#include "modules/accuracy/ledger/measurement_store.h"
#include "modules/accuracy/module.h"
#include "modules/accuracy/points/points_run.h"

namespace gloam {
namespace {

/// Rows that are measured, or found in the store.
class LedgerRun {
 public:
  LedgerRun(const CostRequest& request, CostSubject& subject, CostProgress& progress)
      : request_(request),
        subject_(subject),
        progress_(progress),
        store_(request.folder + "/measurements"),
        default_times_(request.folder + "/default_times"),
        settings_(subject),
        whole_(request, subject, settings_),
        plan_(request.header.seconds) {
    const std::vector<PlannedRow> rows = planned_rows();
    total_ = rows.size();
    left_timed_ = static_cast<std::size_t>(std::ranges::count(rows, false, &PlannedRow::is_default));
    progress_.plan(rows);
  }

  [[nodiscard]] Status measure(const std::string& name) {
    KnobMeasurement measurement(request_, subject_, progress_, whole_, settings_, plan_, knob(name));
    bool own_timed = false;
    KnobRows& rows = knobs_.emplace_back(KnobRows{knob(name).module, measurement.default_is_users(), {}});
    bool& timed = rows.default_is_users ? users_timed_ : own_timed;
    for (const std::string& value : ledger_values(knob(name))) {
      GLOAM_TRY(add(measurement, name, value, rows));
      timed = timed || !rows.rows.back().standard.empty();
    }
    if (timed) return {};
    // Nothing was timed beside the default: the first knob has one value, or none that changes anything.
    timed = true;
    TimedRow& first = rows.rows.front();
    const std::string identity = measurement.identity(first.row.value);
    if (const std::optional<TimedRow> known = default_times_.load(identity)) {
      first.standard = known->standard;
      return {};
    }
    auto frames = measurement.time_default();
    if (!frames) return frames.error();
    first.standard = std::move(frames).value();
    return default_times_.save(identity, first);
  }

  /// The rows, with fronts.
  [[nodiscard]] std::vector<LedgerRow> finish() {
    share_default_times(knobs_);
    return marked_rows();
  }

  /// Measures the combinations that the rows promise. They share the default's time with the rows.
  [[nodiscard]] Status measure_points(Ledger& ledger) {
    PointsRun points(request_, subject_, progress_, whole_, settings_, plan_, ledger.rows);
    GLOAM_TRY(points.measure());
    knobs_.push_back(std::move(points.rows()));
    share_default_times(knobs_);
    points.rows() = std::move(knobs_.back());
    knobs_.pop_back();
    ledger.rows = marked_rows();
    ledger.points = points.finish();
    ledger.model = model_quality(ledger.points);
    return {};
  }

 private:
  [[nodiscard]] const Knob& knob(const std::string& name) const {
    const Knob* found = subject_.knobs().find(name);
    GLOAM_ASSERT(found != nullptr, "a measured knob exists");
    return *found;
  }

  [[nodiscard]] std::vector<PlannedRow> planned_rows() const {
    const std::vector<ReferenceInfo> references = subject_.references();
    std::vector<PlannedRow> rows;
    for (const std::string& name : request_.knobs) {
      const std::string standard = value_text(knob(name), knob(name).default_number);
      const bool from_reference = std::ranges::find(references, name, &ReferenceInfo::knob) != references.end();
      for (const std::string& value : ledger_values(knob(name)))
        rows.push_back({name, value, value == standard, from_reference});
    }
    return rows;
  }

  [[nodiscard]] Status add(KnobMeasurement& measurement, const std::string& name, const std::string& value,
                           KnobRows& rows) {
    const std::string identity = measurement.identity(value);
    std::optional<TimedRow> row = store_.load(identity);
    if (row && !has_pictures(row->row)) row.reset();
    const bool resumed = row.has_value();
    if (!resumed) {
      progress_.measuring(name, value, done_, total_);
      plan_.begin_row(total_ - done_ + request_.points, left_timed_ + request_.points);
      auto measured = measurement.measure(value);
      plan_.end_row();
      if (!measured) return Error{measured.error().kind, name + "=" + value + ": " + measured.error().message};
      progress_.phase(CostPhase::other);
      row = std::move(measured).value();
      GLOAM_TRY(store_.save(identity, *row));
    }
    progress_.finished(row->row, resumed);
    ++done_;
    left_timed_ -= row->row.is_default ? 0 : 1;
    rows.rows.push_back(std::move(*row));
    return {};
  }

  [[nodiscard]] std::vector<LedgerRow> marked_rows() const {
    std::vector<LedgerRow> rows;
    for (const KnobRows& knob : knobs_)
      for (const TimedRow& measured : knob.rows) rows.push_back(measured.row);
    mark_pareto_front(rows);
    return rows;
  }

  [[nodiscard]] bool has_pictures(const LedgerRow& row) {
    return std::ranges::all_of(row_pictures(row),
                               [this](const std::string& name) { return progress_.has_picture(name); });
  }

  const CostRequest& request_;
  CostSubject& subject_;
  CostProgress& progress_;
  const MeasurementStore store_;
  const MeasurementStore default_times_;  ///< rows of defaults that were timed alone
  DrawnSettings settings_;
  WholeFrame whole_;
  bool users_timed_ = false;  ///< a row has frames of the user's settings, which give all rows of them their time
  TimePlan plan_;
  std::size_t left_timed_ = 0;  ///< rows that are not finished, without those of defaults
  std::size_t done_ = 0;
  std::size_t total_ = 0;
  std::vector<KnobRows> knobs_;
};

}  // namespace

Result<Ledger> measure_costs(const CostRequest& request, CostSubject& subject, CostProgress& progress) {
  GLOAM_ASSERT(request.header.frames > 0 && request.sequence > 0, "a ledger is of at least one frame");
  LedgerRun run(request, subject, progress);
  for (const std::string& name : request.knobs) GLOAM_TRY(run.measure(name));
  Ledger ledger = {.header = request.header, .rows = run.finish(), .skipped = request.skipped};
  if (request.points > 0 && !ledger.rows.empty()) GLOAM_TRY(run.measure_points(ledger));
  return ledger;
}

}  // namespace gloam
