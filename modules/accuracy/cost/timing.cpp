// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/timing.h"

#include <algorithm>

#include "engine/core/assert.h"

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

/// Of the pairs whose standard frame has a time.
std::vector<double> ratios_of(const AlternatingTimes& times) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < times.candidate.size(); ++i)
    if (times.standard[i].ms() > 0.0) ratios.push_back(times.candidate[i].ms() / times.standard[i].ms());
  return ratios;
}

bool known_well(const TimingPlan& plan, const AlternatingTimes& times) {
  constexpr std::size_t kPairsBetween = 4;  // an interval takes as long as drawing a small frame
  const std::size_t pairs = times.candidate.size();
  if (pairs < plan.least_pairs || pairs % kPairsBetween != 0) return false;
  std::vector<double> ratios = ratios_of(times);
  if (ratios.empty()) return true;
  const Interval interval = median_interval(ratios);
  const double ratio = quantile(ratios, 0.5);
  return std::max(ratio - interval.low, interval.high - ratio) <= plan.wanted * ratio;
}

template <class Member>
double median_of(const std::vector<FrameCost>& costs, Member&& member) {
  std::vector<double> values;
  for (const FrameCost& cost : costs) values.push_back(member(cost));
  return quantile(values, 0.5);
}

}  // namespace

Result<AlternatingTimes> time_alternating(const TimingPlan& plan, const RunFrame& run) {
  GLOAM_ASSERT(plan.most_pairs > 0, "times are of at least one frame");
  AlternatingTimes times;
  for (const TimedSide side : {TimedSide::standard, TimedSide::candidate})
    GLOAM_TRY(run_side(run, side, plan.first_warm_up, nullptr));
  // A pair begins with the side that the last one ended with: one change of side a pair, and one warm-up.
  bool standard_first = false;
  do {
    const auto standard = [&](std::uint32_t left_out) {
      return run_side(run, TimedSide::standard, left_out, &times.standard);
    };
    const auto candidate = [&](std::uint32_t left_out) {
      return run_side(run, TimedSide::candidate, left_out, &times.candidate);
    };
    if (standard_first) {
      GLOAM_TRY(standard(0));
      GLOAM_TRY(candidate(plan.warm_up));
    } else {
      GLOAM_TRY(candidate(0));
      GLOAM_TRY(standard(plan.warm_up));
    }
    standard_first = !standard_first;
  } while (times.candidate.size() < plan.most_pairs && !known_well(plan, times));
  return times;
}

TimedValue summarize_frames(const std::vector<FrameCost>& frames, std::string_view module) {
  GLOAM_ASSERT(!frames.empty(), "times are of at least one frame");
  std::vector<double> ms;
  for (const FrameCost& cost : frames) ms.push_back(cost.ms());
  TimedValue value;
  value.ms = {.median_ms = quantile(ms, 0.5), .p10_ms = quantile(ms, 0.1), .p90_ms = quantile(ms, 0.9)};
  value.wall_ms = median_of(frames, [](const FrameCost& cost) { return cost.wall_ms(); });
  value.cpu_ms = median_of(frames, [](const FrameCost& cost) { return cost.cpu_ms; });
  value.gpu_ms = median_of(frames, [](const FrameCost& cost) { return cost.gpu_ms; });
  value.module_cpu_ms = median_of(frames, [&](const FrameCost& cost) { return cost.of(module).cpu_ms; });
  value.module_gpu_ms = median_of(frames, [&](const FrameCost& cost) { return cost.of(module).gpu_ms; });
  return value;
}

TimedValue summarize_times(const AlternatingTimes& times, std::string_view module) {
  GLOAM_ASSERT(times.standard.size() == times.candidate.size(), "times come in pairs");
  TimedValue value = summarize_frames(times.candidate, module);
  std::vector<double> ratios = ratios_of(times);
  if (ratios.empty()) return value;
  value.ratio_interval = median_interval(ratios);
  value.sure_interval = median_interval(ratios, kSureProbability);
  value.ratio = quantile(ratios, 0.5);
  return value;
}

void set_times(const TimedValue& timed, LedgerRow& row) {
  row.ms = timed.ms;
  row.wall_ms = timed.wall_ms;
  row.cpu_ms = timed.cpu_ms;
  row.gpu_ms = timed.gpu_ms;
  row.module_cpu_ms = timed.module_cpu_ms;
  row.module_gpu_ms = timed.module_gpu_ms;
  row.ratio = timed.ratio;
  row.ratio_low = timed.ratio_interval.low;
  row.ratio_high = timed.ratio_interval.high;
  row.sure_low = timed.sure_interval.low;
  row.sure_high = timed.sure_interval.high;
}

}  // namespace gloam
