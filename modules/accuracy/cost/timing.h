// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "modules/accuracy/module.h"

namespace gloam {

enum class TimedSide { standard, candidate };

struct TimingPlan {
  std::uint32_t pairs = kLedgerFrames;  ///< measured frames a side, > 0
  std::uint32_t first_warm_up = 3;      ///< frames a side before anything is measured: pipelines, memory, caches
  std::uint32_t warm_up = 1;            ///< frames after every change of side that are left out
};

/// Costs of the measured frames, in order; the i-th of one side stood next to the i-th of the other.
struct AlternatingTimes {
  std::vector<FrameCost> standard;
  std::vector<FrameCost> candidate;
};

/// Puts a side in force (when it differs from the last call's) and draws one frame.
using RunFrame = std::function<Result<FrameCost>(TimedSide)>;

/// A, B, A, B …: a machine that drifts favours neither side.
[[nodiscard]] Result<AlternatingTimes> time_alternating(const TimingPlan& plan, const RunFrame& run);

struct TimedValue {
  TimeSummary ms;
  double cpu_ms = 0.0;  ///< medians
  double gpu_ms = 0.0;
  double module_cpu_ms = 0.0;  ///< medians of one module's share
  double module_gpu_ms = 0.0;
  double ratio = 1.0;  ///< candidate over standard, median over pairs; pairs without a time are left out
};

/// Of the candidate. module: whose share is told.
[[nodiscard]] TimedValue summarize_times(const AlternatingTimes& times, std::string_view module = {});

}  // namespace gloam
