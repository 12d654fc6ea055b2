// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/points/points_run.h"

#include <algorithm>
#include <cmath>
#include <optional>
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

ModelRatio ratio_of(std::vector<double> ratios) {
  if (ratios.empty()) return {};
  const auto far = [](double ratio) { return std::abs(std::log(ratio)); };
  const double worst = *std::ranges::max_element(ratios, {}, far);
  return {.median = quantile(ratios, 0.5), .worst = worst};
}

}  // namespace

PointsRun::PointsRun(std::span<const std::unique_ptr<CameraRun>> cameras, CostProgress& progress, TimePlan& plan,
                     std::size_t most, const std::vector<LedgerRow>& rows)
    : cameras_(cameras),
      progress_(progress),
      plan_(plan),
      most_(std::max<std::size_t>(most, 2)),
      knobs_(cameras.front()->subject().knobs()),
      model_(rows, knobs_),
      store_(cameras.front()->request().folder + "/measurements"),
      exact_(exact_changes(knobs_)),
      rows_(cameras.size()) {}

bool PointsRun::knows(const Changes& changes) const {
  return std::ranges::find(planned_, changes, &Planned::changes) != planned_.end();
}

Status PointsRun::add_row(CameraRun& camera, const Changes& changes, KnobRows& rows, bool& resumed) {
  PointMeasurement measurement(camera.request(), camera.subject(), progress_, camera.whole(), camera.settings(), plan_,
                               changes);
  const std::string identity = measurement.identity();
  std::optional<TimedRow> row = store_.load(identity);
  if (!row || !has_pictures(row->row, progress_)) {
    resumed = false;
    auto measured = measurement.measure();
    if (!measured) return measured.error();
    row = std::move(measured).value();
    GLOAM_TRY(store_.save(identity, *row));
  }
  rows.rows.push_back(std::move(*row));
  return {};
}

Status PointsRun::add(Changes changes) {
  if (knows(changes)) return {};
  const std::vector<KnobValue> settings = settings_with(knobs_, changes);
  const std::string text = settings_text(settings);
  progress_.measuring_point(text, planned_.size(), most_);
  const std::size_t left = std::max(most_, planned_.size() + 1) - planned_.size();
  bool resumed = true;
  for (std::size_t camera = 0; camera < cameras_.size(); ++camera) {
    const std::size_t rows_left = left * cameras_.size() - camera;
    plan_.begin_row(rows_left, rows_left);
    const Status added = add_row(*cameras_[camera], changes, rows_[camera], resumed);
    plan_.end_row();
    if (!added.ok()) return Error{added.error().kind, text + ": " + added.error().message};
  }
  progress_.phase(CostPhase::other);
  const Cost predicted = model_.predict(changes);
  const bool is_exact = changes == exact_;
  planned_.push_back({std::move(changes), predicted});
  LedgerPoint point = {.settings = settings, .is_exact = is_exact, .measured = worst(planned_.size() - 1)};
  point.predicted_ms = predicted.ratio * point.measured.ms.median_ms / std::max(point.measured.ratio, 1e-9);
  point.predicted_flip = predicted.error();
  progress_.finished_point(point, resumed);
  return {};
}

std::vector<LedgerRow> PointsRun::rows_of(std::size_t index) const {
  std::vector<LedgerRow> rows;
  for (const KnobRows& camera : rows_) rows.push_back(camera.rows[index].row);
  return rows;
}

LedgerRow PointsRun::worst(std::size_t index) const {
  // All points show the camera in which the user's settings are least right, so that their pictures can be compared.
  const std::vector<LedgerRow> users = rows_of(0);
  std::vector<double> default_ms;
  std::size_t shown = 0;
  for (std::size_t camera = 0; camera < users.size(); ++camera) {
    default_ms.push_back(users[camera].ms.median_ms);
    if (users[camera].flip->mean > users[shown].flip->mean) shown = camera;
  }
  return worst_point(rows_of(index), default_ms, shown);
}

Status PointsRun::improve_front() {
  Improvements improvements;
  while (planned_.size() < most_) {
    std::vector<MeasuredCost> measured;
    for (std::size_t i = 0; i < planned_.size(); ++i) measured.push_back({planned_[i].changes, cost_of(worst(i))});
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
  const std::size_t candidates = most_ * 2 / 3;
  const std::vector<Changes> front = model_.front();
  for (const Changes& changes : spread(model_, front, candidates))
    if (planned_.size() < candidates) GLOAM_TRY(add(changes));
  GLOAM_TRY(improve_front());
  // No neighbour promises anything: fill the gaps of the predicted front.
  for (const Changes& changes : spread(model_, front, most_))
    if (planned_.size() < most_) GLOAM_TRY(add(changes));
  return {};
}

std::vector<LedgerPoint> PointsRun::finish() const {
  std::vector<LedgerRow> marked;
  for (std::size_t i = 0; i < planned_.size(); ++i) {
    marked.push_back(worst(i));
    // Settings are equal if their pictures are in all cameras.
    marked.back().picture.clear();
    for (const LedgerRow& row : rows_of(i)) marked.back().picture += row.picture + " ";
  }
  mark_pareto_front(marked);
  double users_ms = 0.0;
  for (const LedgerRow& row : marked)
    if (row.is_default) users_ms = row.ms.median_ms;
  std::vector<LedgerPoint> points;
  for (std::size_t i = 0; i < marked.size(); ++i) {
    LedgerPoint& point = points.emplace_back();
    point.settings = settings_with(knobs_, planned_[i].changes);
    point.is_exact = planned_[i].changes == exact_;
    point.measured = worst(i);
    point.measured.on_front = marked[i].on_front;
    point.measured.no_effect = false;  // said of values, not of combinations
    point.predicted_ms = planned_[i].predicted.ratio * users_ms;
    point.predicted_flip = planned_[i].predicted.error();
    if (cameras_.size() > 1) point.cameras = rows_of(i);
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
