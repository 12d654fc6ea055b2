// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/drawing/session_budget.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/core/text/formatted.h"
#include "modules/accuracy/outputs.h"
#include "sandbox/output/identity.h"
#include "sandbox/session/loading/kept_ledger.h"

namespace gloam {
namespace {

/// What the ledger was measured on that differs; empty: nothing.
std::string differences(const LedgerHeader& header, const Session& session, const Options& options) {
  std::string text;
  const auto add = [&](const std::string& what, bool differs) {
    if (differs) text += (text.empty() ? "" : ", ") + what;
  };
  add("scene " + header.scene, header.scene_hash != scene_hash(options.scene, session.world));
  add("device " + header.device, header.device != session.device->info().name);
  add(formatted("size %ux%u", header.width, header.height),
      header.width != options.width || header.height != options.height);
  return text;
}

}  // namespace

Status set_budget(Session& session, const Options& options, LogSink& log) {
  if (!options.budget_ms) return {};
  const auto found = find_ledger(session, options);
  if (!found) return found.error();
  if (const std::string other = differences(found->ledger.header, session, options); !other.empty())
    log.warning(found->path + " was measured with another " + other + ": only ratios of its times are used");
  FrameBudget budget = {.ms = *options.budget_ms, .front = front_points(found->ledger)};
  for (const std::string& assignment : options.assignments)
    budget.locked.push_back(assignment.substr(0, assignment.find('=')));
  const Status set = session.renderer->set_budget(std::move(budget));
  return set.ok() ? set : Error{ErrorKind::input, found->path + ": " + set.error().message};
}

std::string budget_text(const GovernorDecision& decision, const BudgetState& state) {
  std::string reason(governor_reason_name(decision.reason));
  std::ranges::replace(reason, '_', ' ');
  std::string text = reason + formatted(": %.3g ms, %.3g wanted", decision.measured_ms, decision.budget_ms);
  if (!decision.changed()) return text;
  return text + formatted("; now setting %zu of %zu, about %.3g ms, error %.3g", decision.point + 1, state.points,
                          decision.predicted_ms, state.error);
}

}  // namespace gloam
