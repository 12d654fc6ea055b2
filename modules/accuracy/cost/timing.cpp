// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/timing.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "engine/core/assert.h"

namespace gloam {
namespace {

Status run_frames(const RunFrame& run, TimedSide side, std::uint32_t count) {
  for (std::uint32_t frame = 0; frame < count; ++frame) GLOAM_TRY(run(side));
  return {};
}

/// Measures one side in its turn, and puts its frames into the times of the candidates that they belong to.
Status measure_side(const RunFrame& run, TimedSide side, std::uint32_t count, std::span<const TimedSide> order,
                    std::vector<AlternatingTimes>& times) {
  for (std::uint32_t frame = 0; frame < count; ++frame) {
    auto cost = run(side);
    if (!cost) return cost.error();
    if (side != kStandardSide) {
      times[side - 1].candidate.push_back(std::move(cost).value());
      continue;
    }
    for (const TimedSide candidate : order)
      if (candidate != kStandardSide) times[candidate - 1].standard.push_back(*cost);
  }
  return {};
}

/// Of the pairs whose standard frame has a time.
std::vector<double> ratios_of(const AlternatingTimes& times) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < times.candidate.size(); ++i)
    if (times.standard[i].ms() > 0.0) ratios.push_back(times.candidate[i].ms() / times.standard[i].ms());
  return ratios;
}

/// Frames of one turn may be slow together. Resampling turns allows for that, but few turns give too narrow intervals;
/// the wider one of both counts at each end.
Interval bootstrap_interval(const std::vector<double>& ratios, double probability) {
  const Interval pairs = median_interval(ratios, probability);
  const Interval turns = median_interval(ratios, probability, kPairsTogether);
  return {std::min(pairs.low, turns.low), std::max(pairs.high, turns.high)};
}

/// 95 % interval of the median.
Interval interval_of(const std::vector<double>& ratios) {
  if (ratios.size() >= kBootstrapPairs) return bootstrap_interval(ratios, 0.95);
  const auto [least, most] = std::ranges::minmax_element(ratios);
  return {*least, *most};
}

/// kSureProbability. The median lies outside the range of n ratios with 2^(1 - n): 0.2 % from ten on. The range of
/// fewer is widened by its length on both sides.
Interval sure_interval_of(const std::vector<double>& ratios) {
  constexpr std::size_t kSurePairs = 10;
  if (ratios.size() >= kBootstrapPairs) return bootstrap_interval(ratios, kSureProbability);
  const Interval range = interval_of(ratios);
  const double more = ratios.size() < kSurePairs ? range.high - range.low : 0.0;
  return {std::max(range.low - more, 0.0), range.high + more};
}

bool known_well(const TimingPlan& plan, const AlternatingTimes& times) {
  constexpr std::size_t kPairsBetween = 4;  // a bootstrap takes as long as drawing a small frame
  const std::size_t pairs = times.candidate.size();
  if (pairs < kLeastPairs || (pairs >= kBootstrapPairs && pairs % kPairsBetween != 0)) return false;
  std::vector<double> ratios = ratios_of(times);
  if (ratios.empty()) return true;
  const Interval interval = interval_of(ratios);
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

Result<std::vector<AlternatingTimes>> time_alternating(const TimingPlan& plan, std::size_t candidates,
                                                       const RunFrame& run) {
  GLOAM_ASSERT(plan.most_pairs > 0, "times are of at least one frame");
  GLOAM_ASSERT(candidates > 0 && candidates <= kMostCandidates, "the default has a candidate on one side or on both");
  std::vector<AlternatingTimes> times(candidates);
  std::vector<TimedSide> order = {1, kStandardSide};
  if (candidates == 2) order.push_back(2);
  std::optional<TimedSide> last;
  for (std::uint32_t done = 0; order.size() > 1;) {
    const std::uint32_t pairs = std::min(kPairsTogether, plan.most_pairs - done);
    for (const TimedSide side : order) {
      if (side != last) GLOAM_TRY(run_frames(run, side, plan.warm_up));
      GLOAM_TRY(measure_side(run, side, pairs, order, times));
      last = side;
    }
    done += pairs;
    const bool ends = done >= plan.most_pairs || (plan.out_of_time && done >= kLeastPairs && plan.out_of_time());
    // The next turn begins with the side that this one ended with: one change of side less.
    std::ranges::reverse(order);
    std::erase_if(order,
                  [&](TimedSide side) { return side != kStandardSide && (ends || known_well(plan, times[side - 1])); });
  }
  return times;
}

Result<std::vector<AlternatingTimes>> time_in_plan(const LedgerHeader& header, TimePlan& plan, std::size_t candidates,
                                                   const RunFrame& run) {
  TimingPlan timing = {.most_pairs = header.frames, .wanted = header.quick ? kQuickInterval : kLedgerInterval};
  timing.out_of_time = plan.begin_timing(candidates);
  auto times = time_alternating(timing, candidates, run);
  plan.end_timing();
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
  value.ratio_interval = interval_of(ratios);
  value.sure_interval = sure_interval_of(ratios);
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
