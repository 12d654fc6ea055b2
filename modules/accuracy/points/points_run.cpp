// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/points/points_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "modules/accuracy/metrics/statistics.h"
#include "modules/accuracy/points/point_choice.h"
#include "modules/accuracy/points/point_measurement.h"

namespace gloam {
namespace {

/// The exact setting as changes against the user's.
Changes exact_changes(const KnobRegistry& knobs) {
  Changes changes;
  for (const KnobOverride& exact : exact_settings(knobs))
    if (knobs.text(*knobs.find(exact.name)) != exact.value) changes.emplace(exact.name, exact.value);
  return changes;
}

Cost cost_of(const LedgerRow& row) {
  return {.ratio = row.is_default ? 1.0 : row.ratio, .squared_error = row.flip->mean * row.flip->mean};
}

bool has_pictures(const LedgerRow& row, CostProgress& progress) {
  return std::ranges::all_of(row_pictures(row), [&](const std::string& name) { return progress.has_picture(name); });
}

ModelRatio ratio_of(std::vector<double> ratios) {
  if (ratios.empty()) return {};
  const auto far = [](double ratio) { return std::abs(std::log(ratio)); };
  const double worst = *std::ranges::max_element(ratios, {}, far);
  return {.median = quantile(ratios, 0.5), .worst = worst};
}

}  // namespace

PointsRun::PointsRun(const CostRequest& request, CostSubject& subject, CostProgress& progress, WholeFrame& whole,
                     DrawnSettings& drawn, TimePlan& plan, const std::vector<LedgerRow>& rows)
    : request_(request),
      subject_(subject),
      progress_(progress),
      whole_(whole),
      drawn_(drawn),
      plan_(plan),
      model_(rows, subject.knobs()),
      store_(request.folder + "/measurements"),
      exact_(exact_changes(subject.knobs())) {}

bool PointsRun::knows(const Changes& changes) const {
  return std::ranges::find(planned_, changes, &Planned::changes) != planned_.end();
}

Status PointsRun::add(Changes changes) {
  if (knows(changes)) return {};
  PointMeasurement measurement(request_, subject_, progress_, whole_, drawn_, plan_, changes);
  const std::string identity = measurement.identity();
  std::optional<TimedRow> row = store_.load(identity);
  if (row && !has_pictures(row->row, progress_)) row.reset();
  const bool resumed = row.has_value();
  if (!resumed) {
    const std::string text = settings_text(settings_with(subject_.knobs(), changes));
    progress_.measuring_point(text, planned_.size(), std::max<std::size_t>(request_.points, 2));
    const std::size_t left = std::max<std::size_t>(request_.points, planned_.size() + 1) - planned_.size();
    plan_.begin_row(left, left);
    auto measured = measurement.measure();
    plan_.end_row();
    if (!measured) return Error{measured.error().kind, text + ": " + measured.error().message};
    progress_.phase(CostPhase::other);
    row = std::move(measured).value();
    GLOAM_TRY(store_.save(identity, *row));
  }
  const Cost predicted = model_.predict(changes);
  progress_.finished_point({.settings = settings_with(subject_.knobs(), changes),
                            .is_exact = changes == exact_,
                            .measured = row->row,
                            .predicted_ms = predicted.ratio * row->row.ms.median_ms / std::max(row->row.ratio, 1e-9),
                            .predicted_flip = predicted.error()},
                           resumed);
  planned_.push_back({std::move(changes), predicted});
  rows_.rows.push_back(std::move(*row));
  return {};
}

Status PointsRun::improve_front() {
  Improvements improvements;
  while (planned_.size() < request_.points) {
    std::vector<MeasuredCost> measured;
    for (std::size_t i = 0; i < planned_.size(); ++i)
      measured.push_back({planned_[i].changes, cost_of(rows_.rows[i].row)});
    std::optional<Changes> next = improve(model_, measured, improvements);
    if (!next) return {};
    GLOAM_TRY(add(std::move(*next)));
  }
  return {};
}

Status PointsRun::measure() {
  GLOAM_TRY(add({}));
  GLOAM_TRY(add(exact_));
  // Two thirds are candidates of the model. What they show directs the rest.
  const std::size_t candidates = std::max<std::size_t>(request_.points, 2) * 2 / 3;
  const std::vector<Changes> front = model_.front();
  for (const Changes& changes : spread(model_, front, candidates))
    if (planned_.size() < candidates) GLOAM_TRY(add(changes));
  GLOAM_TRY(improve_front());
  // No neighbour promises anything: fill the gaps of the predicted front.
  for (const Changes& changes : spread(model_, front, request_.points))
    if (planned_.size() < request_.points) GLOAM_TRY(add(changes));
  return {};
}

std::vector<LedgerPoint> PointsRun::finish() const {
  std::vector<LedgerRow> measured;
  for (const TimedRow& row : rows_.rows) measured.push_back(row.row);
  mark_pareto_front(measured);
  double users_ms = 0.0;
  for (const LedgerRow& row : measured)
    if (row.is_default) users_ms = row.ms.median_ms;
  std::vector<LedgerPoint> points;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    points.push_back({.settings = settings_with(subject_.knobs(), planned_[i].changes),
                      .is_exact = planned_[i].changes == exact_,
                      .measured = std::move(measured[i]),
                      .predicted_ms = planned_[i].predicted.ratio * users_ms,
                      .predicted_flip = planned_[i].predicted.error()});
    points.back().measured.no_effect = false;  // said of values, not of combinations
  }
  std::ranges::stable_sort(points, {}, [](const LedgerPoint& point) { return point.measured.ms.median_ms; });
  return points;
}

ModelQuality model_quality(const std::vector<LedgerPoint>& points) {
  std::vector<double> times, errors;
  for (const LedgerPoint& point : points) {
    if (point.measured.is_default || point.is_exact) continue;
    if (point.predicted_ms > 0.0 && point.measured.ms.median_ms > 0.0)
      times.push_back(point.measured.ms.median_ms / point.predicted_ms);
    if (point.predicted_flip > 0.0 && point.measured.flip->mean > 0.0)
      errors.push_back(point.measured.flip->mean / point.predicted_flip);
  }
  const auto count = static_cast<std::uint32_t>(times.size());
  return {.points = count, .time = ratio_of(std::move(times)), .error = ratio_of(std::move(errors))};
}

}  // namespace gloam
