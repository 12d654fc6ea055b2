// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "modules/accuracy/cost/time_plan.h"
#include "modules/accuracy/metrics/statistics.h"
#include "modules/accuracy/module.h"

namespace gloam {

/// The default is kStandardSide; candidates follow it.
using TimedSide = std::size_t;
inline constexpr TimedSide kStandardSide = 0;
/// Candidates beside one default: each side of it takes one, so that their frames follow each other.
inline constexpr std::size_t kMostCandidates = 2;

struct TimingPlan {
  std::uint32_t most_pairs = kLedgerFrames;  ///< measured frames per side, > 0
  /// A candidate is measured until its ratio's interval reaches at most this far from the ratio, relative to it.
  double wanted = 0.02;
  std::uint32_t warm_up = 1;  ///< unmeasured frames after every change of side
  /// Whether measuring ends although the interval is wide, after at least kLeastPairs; may be null.
  std::function<bool()> out_of_time = nullptr;
};

/// Frames of a side that are measured before the next side's turn, which costs warm-up frames.
inline constexpr std::uint32_t kPairsTogether = 2;
/// Fewer are not asked for their interval: the range of six ratios holds their true median with 96.9 %.
inline constexpr std::uint32_t kLeastPairs = 6;
/// From here on the bootstrap gives intervals. Of fewer pairs its intervals are too narrow, and the range of all ratios
/// is taken.
inline constexpr std::uint32_t kBootstrapPairs = 12;

/// Costs of the measured frames, in order. The i-th frames of the two sides were measured next to each other.
struct AlternatingTimes {
  std::vector<FrameCost> standard;
  std::vector<FrameCost> candidate;
};

/// Applies the knob value of a side, if the last call was for the other side, and draws one frame.
using RunFrame = std::function<Result<FrameCost>(TimedSide)>;

/// Alternates each candidate with the default (BB AA CC, CC AA BB, BB AA CC …), so that a drift of the machine's speed
/// affects both, until each ratio is known well enough. All sides must have been drawn before: the first warm-up makes
/// no pipelines. candidates: 1 to kMostCandidates. One result for each.
[[nodiscard]] Result<std::vector<AlternatingTimes>> time_alternating(const TimingPlan& plan, std::size_t candidates,
                                                                     const RunFrame& run);

/// time_alternating() as a ledger's header says, in as many rows' shares of the ledger's time.
[[nodiscard]] Result<std::vector<AlternatingTimes>> time_in_plan(const LedgerHeader& header, TimePlan& plan,
                                                                 std::size_t candidates, const RunFrame& run);

/// Of values that change nothing, one in twenty would lie outside a 95 % interval, and there are a hundred in a ledger.
inline constexpr double kSureProbability = 0.998;

struct TimedValue {
  TimeSummary ms;
  double wall_ms = 0.0;  ///< medians
  double cpu_ms = 0.0;
  double gpu_ms = 0.0;
  double module_cpu_ms = 0.0;  ///< medians of the module's share
  double module_gpu_ms = 0.0;
  double ratio = 1.0;  ///< candidate / standard, median over pairs; pairs with a standard time of 0 are left out
  Interval ratio_interval = {1.0, 1.0};  ///< 95 %
  Interval sure_interval = {1.0, 1.0};   ///< kSureProbability
};

/// Statistics of frames of one setting; the ratio is 1.
[[nodiscard]] TimedValue summarize_frames(const std::vector<FrameCost>& frames, std::string_view module = {});

/// Statistics of the candidate. `module`: the module that module_cpu_ms and module_gpu_ms refer to.
[[nodiscard]] TimedValue summarize_times(const AlternatingTimes& times, std::string_view module = {});

/// Puts times and ratio into a row.
void set_times(const TimedValue& timed, LedgerRow& row);

}  // namespace gloam
