// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "sandbox/options.h"
#include "sandbox/session/session.h"

namespace gloam {

/// Sets the renderer's budget to --budget, with the combinations of find_ledger() to choose from; knobs of --set keep
/// their values. Without --budget it does nothing. Warns of a ledger of another scene, device or size: it is used all
/// the same, because only ratios of its times count.
[[nodiscard]] Status set_budget(Session& session, const Options& options, LogSink& log);

/// Why the budget has moved, in a line: "over budget: 41.2 ms, 33 wanted; now setting 3 of 8, about 29.6 ms, error
/// 0.051". decision: one with a reason. state: after it.
[[nodiscard]] std::string budget_text(const GovernorDecision& decision, const BudgetState& state);

}  // namespace gloam
