// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/governor/budgets.h"

#include <algorithm>
#include <utility>

#include "engine/core/text/nearest_name.h"

namespace gloam {
namespace {

std::string budget_of(const std::string& effect) {
  return effect.empty() ? "the budget of whole frames" : "the budget of " + effect;
}

}  // namespace

Status Budgets::set(FrameBudget budget, std::span<const std::string> effects, KnobRegistry& knobs) {
  if (!budget.effect.empty() && std::ranges::find(effects, budget.effect) == effects.end())
    return Error{ErrorKind::usage,
                 "there is no effect '" + budget.effect + "'; " + valid_names(budget.effect, effects)};
  auto created = BudgetControl::create(std::move(budget), knobs);
  if (!created.ok()) return created.error();
  BudgetControl control = std::move(created).value();
  GLOAM_TRY(check_shared(control));
  control.apply(knobs);
  if (BudgetControl* old = find(control.effect()))
    *old = std::move(control);
  else
    controls_.push_back(std::move(control));
  return {};
}

Status Budgets::check_shared(const BudgetControl& control) const {
  for (const BudgetControl& other : controls_)
    if (other.effect() != control.effect())
      if (const std::string* knob = control.shared_knob(other))
        return Error{ErrorKind::usage,
                     budget_of(other.effect()) + " sets " + *knob + ": lock it in " + budget_of(control.effect())};
  return {};
}

Status Budgets::change(std::string_view effect, double ms, std::vector<std::string> locked, KnobRegistry& knobs) {
  BudgetControl* control = find(effect);
  if (control == nullptr) return Error{ErrorKind::usage, budget_of(std::string(effect)) + " is not set"};
  BudgetControl changed = *control;
  GLOAM_TRY(changed.change(ms, std::move(locked), knobs));
  GLOAM_TRY(check_shared(changed));
  changed.apply(knobs);
  *control = std::move(changed);
  return {};
}

void Budgets::clear(std::string_view effect) {
  std::erase_if(controls_, [&](const BudgetControl& control) { return control.effect() == effect; });
}

BudgetControl* Budgets::find(std::string_view effect) {
  const auto found = std::ranges::find(controls_, effect, &BudgetControl::effect);
  return found == controls_.end() ? nullptr : &*found;
}

std::vector<BudgetState> Budgets::states() const {
  std::vector<BudgetState> states;
  for (const BudgetControl& control : controls_) states.push_back(control.state());
  return states;
}

}  // namespace gloam
