// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/timing.h"

#include "engine/core/assert.h"
#include "modules/accuracy/metrics/statistics.h"

namespace gloam {
namespace {

Status run_side(const RunFrame& run, TimedSide side, std::uint32_t left_out, std::vector<FrameCost>* measured) {
  for (std::uint32_t frame = 0; frame < left_out; ++frame) GLOAM_TRY(run(side));
  if (measured == nullptr) return {};
  auto cost = run(side);
  if (!cost) return cost.error();
  measured->push_back(*cost);
  return {};
}

template <class Member>
double median_of(const std::vector<FrameCost>& costs, Member&& member) {
  std::vector<double> values;
  for (const FrameCost& cost : costs) values.push_back(member(cost));
  return quantile(values, 0.5);
}

}  // namespace

Result<AlternatingTimes> time_alternating(const TimingPlan& plan, const RunFrame& run) {
  GLOAM_ASSERT(plan.pairs > 0, "times are of at least one frame");
  AlternatingTimes times;
  for (const TimedSide side : {TimedSide::standard, TimedSide::candidate})
    GLOAM_TRY(run_side(run, side, plan.first_warm_up, nullptr));
  for (std::uint32_t pair = 0; pair < plan.pairs; ++pair) {
    GLOAM_TRY(run_side(run, TimedSide::standard, plan.warm_up, &times.standard));
    GLOAM_TRY(run_side(run, TimedSide::candidate, plan.warm_up, &times.candidate));
  }
  return times;
}

TimedValue summarize_times(const AlternatingTimes& times, std::string_view module) {
  GLOAM_ASSERT(!times.candidate.empty(), "times are of at least one frame");
  GLOAM_ASSERT(times.standard.size() == times.candidate.size(), "times come in pairs");
  std::vector<double> ms;
  std::vector<double> ratios;
  for (std::size_t i = 0; i < times.candidate.size(); ++i) {
    ms.push_back(times.candidate[i].ms());
    if (times.standard[i].ms() > 0.0) ratios.push_back(times.candidate[i].ms() / times.standard[i].ms());
  }
  TimedValue value;
  value.ms = {.median_ms = quantile(ms, 0.5), .p10_ms = quantile(ms, 0.1), .p90_ms = quantile(ms, 0.9)};
  value.cpu_ms = median_of(times.candidate, [](const FrameCost& cost) { return cost.cpu_ms; });
  value.gpu_ms = median_of(times.candidate, [](const FrameCost& cost) { return cost.gpu_ms; });
  value.module_cpu_ms = median_of(times.candidate, [&](const FrameCost& cost) { return cost.of(module).cpu_ms; });
  value.module_gpu_ms = median_of(times.candidate, [&](const FrameCost& cost) { return cost.of(module).gpu_ms; });
  if (!ratios.empty()) value.ratio = quantile(ratios, 0.5);
  return value;
}

}  // namespace gloam
