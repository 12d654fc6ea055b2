// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/budget/budget_controls.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/text/formatted.h"
#include "sandbox/session/drawing/session_budget.h"

namespace gloam {
namespace {

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

std::string knobs_text(const BudgetStep& step) {
  std::string text;
  for (const KnobOverride& setting : step.settings)
    text += (text.empty() ? "" : "\n") + setting.name + "=" + setting.value;
  return text.empty() ? "all knobs at their defaults" : text;
}

/// Time now, or before a frame was measured the time that the front's points leave to expect.
std::string difference_text(const BudgetStep& step, double measured_ms, double error) {
  const double ms = step.ms - measured_ms, change = step.error - error;
  std::string text = measured_ms > 0.0 ? formatted("%s %.3g ms", ms < 0.0 ? "saves" : "costs", std::fabs(ms))
                                       : formatted("%.3g ms", step.ms);
  return text + formatted(", error %s%.3g", change < 0.0 ? "-" : "+", std::fabs(change));
}

/// The scale in words. Errors were measured without locks.
std::string error_text(const BudgetState& state) {
  const bool locked =
      std::ranges::any_of(state.named, [&](const std::string& knob) { return has(state.locked, knob); });
  return formatted("error %.3g (mean FLIP, 0 is equal)", state.error) + (locked ? ", without the locks" : "");
}

std::string measured_text(const BudgetState& state) {
  if (state.measured_ms == 0.0) return "no frame measured yet in this setting";
  return formatted("90 %% of frames take at most %.3g ms; the budget is %.3g", state.measured_ms, state.ms);
}

std::string moved_text(const BudgetState& state) {
  if (state.changes == 0) return "the budget has not moved yet";
  return "moved last: " + budget_text(state.last_change, state);
}

}  // namespace

PanelBudget panel_budget(const BudgetState& state, const KnobRegistry& knobs) {
  PanelBudget budget = {.effect = state.effect,
                        .ms = state.ms,
                        .setting = formatted("setting %zu of %zu", state.point + 1, state.points),
                        .error = error_text(state),
                        .measured = measured_text(state),
                        .down = state.cheaper ? difference_text(*state.cheaper, state.measured_ms, state.error)
                                              : "none, this is the fastest",
                        .up = state.better ? difference_text(*state.better, state.measured_ms, state.error)
                                           : "none, this is the most exact",
                        .down_knobs = state.cheaper ? knobs_text(*state.cheaper) : "",
                        .up_knobs = state.better ? knobs_text(*state.better) : "",
                        .moved = moved_text(state)};
  for (const std::string& name : state.named)
    if (const Knob* knob = knobs.find(name)) budget.knobs.push_back({name, knobs.text(*knob), has(state.locked, name)});
  return budget;
}

std::vector<KnobOverride> exact_settings(const std::vector<BudgetState>& budgets) {
  std::vector<KnobOverride> settings;
  for (const BudgetState& budget : budgets) settings.insert(settings.end(), budget.exact.begin(), budget.exact.end());
  return settings;
}

void BudgetControls::begin() {
  states_ = renderer_.budgets();
  shown_.clear();
  for (const BudgetState& state : states_) shown_.push_back(panel_budget(state, renderer_.knobs()));
  // A knob is shown in one budget: that of its effect comes first.
  for (PanelBudget& budget : shown_)
    if (budget.effect.empty())
      std::erase_if(budget.knobs, [&](const PanelBudgetKnob& knob) {
        return std::ranges::any_of(
            states_, [&](const BudgetState& other) { return !other.effect.empty() && has(other.named, knob.name); });
      });
  note_values();
}

void BudgetControls::set_ms(std::size_t index, double ms) { change(index, ms, states_[index].locked); }

void BudgetControls::lock(std::size_t index, const std::string& knob, bool locked) {
  std::vector<std::string> names = states_[index].locked;
  if (locked == has(names, knob)) return;
  if (locked)
    names.push_back(knob);
  else
    std::erase(names, knob);
  change(index, states_[index].ms, std::move(names));
}

void BudgetControls::end() {
  const KnobRegistry& knobs = renderer_.knobs();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    std::vector<std::string> changed;
    for (std::size_t k = 0; k < values_[i].size(); ++k)
      if (const std::string& name = states_[i].governed[k]; knobs.text(*knobs.find(name)) != values_[i][k])
        changed.push_back(name);
    if (changed.empty()) continue;
    std::vector<std::string> locked = states_[i].locked;
    locked.insert(locked.end(), changed.begin(), changed.end());
    change(i, states_[i].ms, std::move(locked));
  }
}

void BudgetControls::change(std::size_t index, double ms, std::vector<std::string> locked) {
  const Status changed = renderer_.change_budget(states_[index].effect, ms, std::move(locked));
  fault_ = changed.ok() ? "" : changed.error().message;
  states_ = renderer_.budgets();
  note_values();
}

void BudgetControls::note_values() {
  const KnobRegistry& knobs = renderer_.knobs();
  values_.clear();
  for (const BudgetState& state : states_) {
    std::vector<std::string>& values = values_.emplace_back();
    for (const std::string& name : state.governed) values.push_back(knobs.text(*knobs.find(name)));
  }
}

}  // namespace gloam
