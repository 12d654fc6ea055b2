// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "sandbox/options.h"
#include "sandbox/session/loading/kept_ledger.h"
#include "sandbox/session/session.h"

namespace gloam {

/// Sets the renderer's budgets to those of --budget, with the combinations of a ledger to choose from; knobs of --set
/// keep their values, and so do those of an effect with a budget of its own in the budget of frames. Without --budget
/// it does nothing. Warns of a ledger of another scene, device or size: it is used all the same, because only ratios of
/// its times count. Usage error for an unknown effect; input error for one that the ledger says nothing of.
[[nodiscard]] Status set_budgets(Session& session, const Options& options, const LedgerFile& ledger, LogSink& log);
/// The same with find_ledger().
[[nodiscard]] Status set_budgets(Session& session, const Options& options, LogSink& log);

/// Milliseconds of a module's passes; above 0 even if it has none, because frames without a time tell a budget nothing.
[[nodiscard]] double effect_ms(const FrameReport& report, const std::string& effect);

/// Tells all budgets of the last frame. frame: for whole frames; effects have the time of their passes in `report`.
/// Returns the decisions with a reason, and the effect of each.
struct BudgetDecision {
  std::string effect;
  GovernorDecision decision;
};
std::vector<BudgetDecision> add_frame_times(Renderer& renderer, const FrameTime& frame, const FrameReport& report);

/// Why a budget has moved, in a line: "over budget: 41.2 ms, 33 wanted; now setting 3 of 8, about 29.6 ms, error
/// 0.051". decision: one with a reason. state: after it.
[[nodiscard]] std::string budget_text(const GovernorDecision& decision, const BudgetState& state);

}  // namespace gloam
