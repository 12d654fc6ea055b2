// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "engine/core/text/formatted.h"
#include "sandbox/bench/governor/case.h"

namespace gloam {
namespace {

constexpr double kVisibleError = 1e-3;

double percentile_90(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.9 * static_cast<double>(values.size()))) - 1;
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

/// 90th percentile of the last half of the run, in which the governor has settled.
double settled_ms(const GovernedRun& run) {
  std::vector<double> ms;
  for (std::size_t i = run.frames.size() / 2; i < run.frames.size(); ++i)
    if (run.frames[i].point == run.frames.back().point) ms.push_back(run.frames[i].ms);
  return percentile_90(std::move(ms));
}

}  // namespace

GovernedFigures figures_of(const GovernedRun& run) {
  GovernedFigures figures;
  std::vector<double> ms;
  double elapsed_s = 0.0, after_step_s = 0.0, rest_s = 0.0, changes = 0.0;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const GovernedFrame& frame = run.frames[i];
    elapsed_s += frame.wall_ms * 1e-3;
    if (run.step_at > 0 && i >= run.step_at) {
      after_step_s += frame.wall_ms * 1e-3;
      if (frame.point < run.frames[i - 1].point) figures.settled_s = after_step_s;
    }
    if (elapsed_s < 1.0) continue;
    ms.push_back(frame.ms / run.budget_ms);
    figures.longest = std::max(figures.longest, frame.ms / run.budget_ms);
    if (elapsed_s < 2.0) continue;
    rest_s += frame.wall_ms * 1e-3;
    changes += frame.point != run.frames[i - 1].point ? 1.0 : 0.0;
  }
  figures.percentile_90 = percentile_90(std::move(ms));
  figures.changes_a_second = rest_s > 0.0 ? changes / rest_s : 0.0;
  return figures;
}

double error_over_best(const GovernedScene& scene, const GovernedRun& run, double share) {
  const GovernedFrame& last = run.frames.back();
  // What frames take on the wall, over the ledger's time of the same setting.
  const double scale = settled_ms(run) / scene.front[last.point].ms;
  double best = last.error;
  for (const TriedSetting& tried : scene.tried)
    if (tried.ms * scale <= share * run.budget_ms) best = std::min(best, tried.error);
  return std::max(last.error, kVisibleError) / std::max(best, kVisibleError);
}

std::string trace_csv(const GovernedScene& scene) {
  std::string text = "run,budget_ms,frame,ms,point,error\n";
  for (const GovernedRun& run : scene.runs)
    for (std::size_t i = 0; i < run.frames.size(); ++i)
      text += run.name + formatted(",%.6g,%zu,%.6g,%zu,%.6g\n", run.budget_ms, i, run.frames[i].ms, run.frames[i].point,
                                   run.frames[i].error);
  return text;
}

std::string settings_csv(const GovernedScene& scene) {
  std::string text = "kind,ms,error\n";
  for (const FrontPoint& point : scene.front) text += formatted("front,%.6g,%.6g\n", point.ms, point.error);
  for (const TriedSetting& tried : scene.tried) text += formatted("tried,%.6g,%.6g\n", tried.ms, tried.error);
  return text;
}

}  // namespace gloam
