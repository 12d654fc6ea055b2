// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/governor/frame_budget.h"
#include "sandbox/bench/harness/context.h"

// A scene under five time budgets, by a ledger of four knobs that is measured first, beside all combinations of these
// knobs' values.

namespace gloam {

inline constexpr std::array<std::string_view, 4> kTriedKnobs = {"shadows.filter", "shadows.texels_per_pixel",
                                                                "reflections.tiers", "views.scale"};
inline constexpr std::size_t kBudgets = 5;

/// A frame that was drawn under a budget.
struct GovernedFrame {
  double ms = 0.0;  ///< what the budget is for, on the wall; more after the step of load
  double wall_ms = 0.0;
  std::size_t point = 0;
  double error = 0.0;  ///< of the point
};

struct GovernedRun {
  double budget_ms = 0.0;
  std::string name;         ///< "standing", "path", "load"
  std::size_t step_at = 0;  ///< frame from which on frames count as longer; 0: none
  std::vector<GovernedFrame> frames;
};

/// A combination that was tried; what it takes is on the wall, as the front's times are.
struct TriedSetting {
  double ms = 0.0;
  double error = 0.0;  ///< mean FLIP against the whole frame
};

struct GovernedScene {
  std::string scene;
  std::string effect;             ///< module whose passes the budget is for; empty: whole frames
  std::vector<FrontPoint> front;  ///< as the renderer sorts it: the fastest first, each more right than all before it
  std::vector<TriedSetting> tried;
  std::vector<GovernedRun> runs;  ///< standing and, with two cameras, on the path through them; then the load
};

/// Of the frames after the first second.
struct GovernedFigures {
  double percentile_90 = 0.0;     ///< over the budget
  double longest = 0.0;           ///< over the budget
  double changes_a_second = 0.0;  ///< after the first two seconds
  double settled_s = 0.0;         ///< from the step of load to the last change to a cheaper point
};
[[nodiscard]] GovernedFigures figures_of(const GovernedRun& run);

/// Error at the end of a run over the least error of the tried settings that fit into a share of the budget. Errors
/// below 0.001 count as 0.001: nobody sees them.
[[nodiscard]] double error_over_best(const GovernedScene& scene, const GovernedRun& run, double share = 1.0);

/// Measures ledger, combinations and runs: several minutes.
[[nodiscard]] Result<GovernedScene> measure_governed_scene(BenchContext& context, const std::string& scene);

/// The runs of a scene at one budget only, without combinations (--budget). An empty effect is the whole frame.
[[nodiscard]] Result<GovernedScene> measure_governed_budget(BenchContext& context, const std::string& scene,
                                                            const EffectBudget& budget);

/// A line for each frame: run, budget, frame, ms, point, error.
[[nodiscard]] std::string trace_csv(const GovernedScene& scene);

/// A line for each point of the front, then for each combination that was tried: kind, ms, error.
[[nodiscard]] std::string settings_csv(const GovernedScene& scene);

}  // namespace gloam
