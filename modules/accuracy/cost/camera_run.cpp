// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/camera_run.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/core/assert.h"

namespace gloam {

CameraRun::CameraRun(const CostRequest& request, CostSubject& subject, CostProgress& progress, double seconds,
                     std::size_t points)
    : request_(request),
      subject_(subject),
      progress_(progress),
      store_(request.folder + "/measurements"),
      default_times_(request.folder + "/default_times"),
      settings_(subject),
      whole_(request, subject, settings_),
      plan_(seconds),
      points_(points) {
  const std::vector<PlannedRow> rows = planned_rows();
  total_ = rows.size();
  left_timed_ = static_cast<std::size_t>(std::ranges::count(rows, false, &PlannedRow::is_default));
  progress_.plan(rows);
}

Status CameraRun::measure(const std::string& name) {
  KnobMeasurement measurement(request_, subject_, progress_, whole_, settings_, plan_, knob(name));
  KnobRows& rows = knobs_.emplace_back(KnobRows{knob(name).module, measurement.default_is_users(), {}});
  std::vector<WaitingRow> waiting;
  for (const std::string& value : ledger_values(knob(name))) {
    GLOAM_TRY(add(measurement, name, value, waiting));
    if (std::ranges::count(waiting, true, &WaitingRow::needs_times) == static_cast<std::ptrdiff_t>(kMostCandidates))
      GLOAM_TRY(finish_rows(measurement, waiting, rows));
  }
  GLOAM_TRY(finish_rows(measurement, waiting, rows));
  bool own_timed = false;
  bool& timed = rows.default_is_users ? users_timed_ : own_timed;
  timed = timed || std::ranges::any_of(rows.rows, [](const TimedRow& row) { return !row.standard.empty(); });
  if (timed) return {};
  // Nothing was timed beside the default: the first knob has one value, or none that changes anything.
  timed = true;
  return time_default(measurement, rows.rows.front());
}

Status CameraRun::time_default(KnobMeasurement& measurement, TimedRow& first) {
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

std::vector<LedgerRow> CameraRun::finish(KnobRows* others) {
  if (others != nullptr) knobs_.push_back(std::move(*others));
  share_default_times(knobs_);
  if (others != nullptr) {
    *others = std::move(knobs_.back());
    knobs_.pop_back();
  }
  std::vector<LedgerRow> rows;
  for (const KnobRows& knob : knobs_)
    for (const TimedRow& measured : knob.rows) rows.push_back(measured.row);
  mark_pareto_front(rows);
  return rows;
}

const Knob& CameraRun::knob(const std::string& name) const {
  const Knob* found = subject_.knobs().find(name);
  GLOAM_ASSERT(found != nullptr, "a measured knob exists");
  return *found;
}

std::vector<PlannedRow> CameraRun::planned_rows() const {
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

Status CameraRun::add(KnobMeasurement& measurement, const std::string& name, const std::string& value,
                      std::vector<WaitingRow>& waiting) {
  const std::string identity = measurement.identity(value);
  std::optional<TimedRow> row = store_.load(identity);
  if (row && has_pictures(row->row, progress_)) {
    waiting.push_back({std::move(*row), identity, true});
    return {};
  }
  const std::size_t begun = done_ + waiting.size();
  progress_.measuring(name, value, begun, total_);
  plan_.begin_row(total_ - begun + points_, left_timed_ + points_);
  auto measured = measurement.measure(value);
  plan_.end_row();
  if (!measured) return Error{measured.error().kind, name + "=" + value + ": " + measured.error().message};
  waiting.push_back({std::move(measured->row), identity, false, measured->needs_times});
  return {};
}

Status CameraRun::finish_rows(KnobMeasurement& measurement, std::vector<WaitingRow>& waiting, KnobRows& rows) {
  std::vector<TimedRow*> untimed;
  std::string values;
  for (WaitingRow& own : waiting) {
    if (!own.needs_times) continue;
    untimed.push_back(&own.row);
    values += (values.empty() ? own.row.row.knob + "=" : " and ") + own.row.row.value;
  }
  if (!untimed.empty())
    if (const Status timed = measurement.time(untimed); !timed.ok())
      return Error{timed.error().kind, values + ": " + timed.error().message};
  progress_.phase(CostPhase::other);
  for (WaitingRow& own : waiting) {
    if (!own.resumed) GLOAM_TRY(store_.save(own.identity, own.row));
    progress_.finished(own.row.row, own.resumed);
    ++done_;
    left_timed_ -= own.row.row.is_default ? 0 : 1;
    rows.rows.push_back(std::move(own.row));
  }
  waiting.clear();
  return {};
}

bool has_pictures(const LedgerRow& row, CostProgress& progress) {
  return std::ranges::all_of(row_pictures(row), [&](const std::string& name) { return progress.has_picture(name); });
}

}  // namespace gloam
