// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include "engine/core/assert.h"
#include "modules/accuracy/cost/camera_run.h"
#include "modules/accuracy/module.h"
#include "modules/accuracy/points/points_run.h"

namespace gloam {
namespace {

using Clock = std::chrono::steady_clock;
using CameraRuns = std::vector<std::unique_ptr<CameraRun>>;

/// What is left of the ledger's time; 0 if it has no limit.
double seconds_left(double seconds, Clock::time_point start) {
  if (seconds <= 0.0) return 0.0;
  constexpr double kLeast = 1e-3;  // spent: each point has the fewest pairs
  return std::max(seconds - std::chrono::duration<double>(Clock::now() - start).count(), kLeast);
}

/// The ledger of the worst rows; with `points`, theirs are the times of the default, too.
Ledger ledger_of(std::span<const CostCamera> cameras, CameraRuns& runs, PointsRun* points = nullptr) {
  std::vector<Ledger> ledgers;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const CostRequest& request = cameras[i].request;
    KnobRows* others = points == nullptr ? nullptr : &points->rows(i);
    ledgers.push_back({.header = request.header, .rows = runs[i]->finish(others), .skipped = request.skipped});
  }
  return worst_of_cameras(std::move(ledgers));
}

}  // namespace

Result<Ledger> measure_costs(std::span<const CostCamera> cameras, CostProgress& progress) {
  GLOAM_ASSERT(!cameras.empty(), "a ledger is of at least one camera");
  const Clock::time_point start = Clock::now();
  const double seconds = cameras.front().request.header.seconds;
  const std::size_t most_points = cameras.front().request.points;
  CameraRuns runs;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const CostRequest& request = cameras[i].request;
    GLOAM_ASSERT(request.header.frames > 0 && request.sequence > 0, "a ledger is of at least one frame");
    progress.begin_camera(i, cameras.size());
    const double share = seconds / static_cast<double>(cameras.size());
    runs.push_back(std::make_unique<CameraRun>(request, *cameras[i].subject, progress, share, most_points));
    for (const std::string& name : request.knobs) GLOAM_TRY(runs.back()->measure(name));
  }
  Ledger ledger = ledger_of(cameras, runs);
  if (most_points == 0 || ledger.rows.empty()) return ledger;
  TimePlan plan(seconds_left(seconds, start));
  PointsRun points(runs, progress, plan, most_points, ledger.rows);
  GLOAM_TRY(points.measure());
  ledger = ledger_of(cameras, runs, &points);
  ledger.points = points.finish();
  ledger.model = model_quality(ledger.points);
  return ledger;
}

Result<Ledger> measure_costs(const CostRequest& request, CostSubject& subject, CostProgress& progress) {
  const CostCamera camera = {request, &subject};
  return measure_costs(std::span(&camera, 1), progress);
}

}  // namespace gloam
