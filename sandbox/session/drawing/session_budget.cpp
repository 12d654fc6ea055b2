// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/drawing/session_budget.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/text/formatted.h"
#include "modules/accuracy/module.h"
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

std::vector<std::string> locked_by_user(const Options& options) {
  std::vector<std::string> names;
  for (const std::string& assignment : options.assignments) names.push_back(assignment.substr(0, assignment.find('=')));
  return names;
}

/// governed: gets the knobs that the budget sets.
Status set_effect_budget(Session& session, const Options& options, const LedgerFile& file, const EffectBudget& own,
                         std::vector<std::string>& governed) {
  Renderer& renderer = *session.renderer;
  FrameBudget budget = {.effect = own.effect,
                        .ms = own.ms,
                        .front = effect_points(file.ledger, own.effect, renderer.knobs()),
                        .locked = locked_by_user(options)};
  const bool exists = std::ranges::any_of(renderer.modules(), [&](const auto& m) { return m->name() == own.effect; });
  if (budget.front.empty() && exists)
    return Error{ErrorKind::input, file.path + ": has no rows of the knobs of " + own.effect +
                                       ", or its passes took no time: measure them with gloam cost"};
  if (!exists) budget.front.push_back({.ms = 1.0, .error = 0.0, .settings = {}});  // for the sentence of set_budget
  GLOAM_TRY(renderer.set_budget(std::move(budget)));
  const auto state = renderer.budget(own.effect);
  governed.insert(governed.end(), state->governed.begin(), state->governed.end());
  return {};
}

}  // namespace

double effect_ms(const FrameReport& report, const std::string& effect) {
  double ms = 1e-3;
  for (const PassTime& pass : report.passes)
    if (pass.module == effect) ms += pass.ms;
  return ms;
}

Status set_budgets(Session& session, const Options& options, const LedgerFile& file, LogSink& log) {
  if (const std::string other = differences(file.ledger.header, session, options); !other.empty())
    log.warning(file.path + " was measured with another " + other + ": only ratios of its times are used");
  std::vector<std::string> locked = locked_by_user(options);
  for (const EffectBudget& own : options.effect_budgets)
    GLOAM_TRY(set_effect_budget(session, options, file, own, locked));
  if (!options.budget_ms) return {};
  const Status set = session.renderer->set_budget(
      {.ms = *options.budget_ms, .front = front_points(file.ledger), .locked = std::move(locked)});
  return set.ok() ? set : Error{ErrorKind::input, file.path + ": " + set.error().message};
}

Status set_budgets(Session& session, const Options& options, LogSink& log) {
  if (!has_budget(options)) return {};
  const auto found = find_ledger(session, options, log);
  return found ? set_budgets(session, options, *found, log) : found.error();
}

std::vector<BudgetDecision> add_frame_times(Renderer& renderer, const FrameTime& frame, const FrameReport& report) {
  std::vector<BudgetDecision> decisions;
  for (const BudgetState& budget : renderer.budgets()) {
    FrameTime time = frame;
    time.effect = budget.effect;
    if (!budget.effect.empty()) time.ms = effect_ms(report, budget.effect);
    const auto decision = renderer.add_frame_time(time);
    if (decision && decision->reason != GovernorReason::none) decisions.push_back({budget.effect, *decision});
  }
  return decisions;
}

std::string budget_text(const GovernorDecision& decision, const BudgetState& state) {
  std::string reason(governor_reason_name(decision.reason));
  std::ranges::replace(reason, '_', ' ');
  if (!state.effect.empty()) reason = state.effect + ": " + reason;
  std::string text = reason + formatted(": %.3g ms, %.3g wanted", decision.measured_ms, decision.budget_ms);
  if (!decision.changed()) return text;
  return text + formatted("; now setting %zu of %zu, about %.3g ms, error %.3g", decision.point + 1, state.points,
                          decision.predicted_ms, state.error);
}

}  // namespace gloam
