// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/governor/budget_control.h"
#include "engine/render/governor/frame_budget.h"
#include "engine/render/knobs/knobs.h"

namespace gloam {

/// The budgets of whole frames and of single effects, in the order in which they were first set. No two set one knob.
class Budgets {
 public:
  /// Sets or replaces the budget of its effect, and the knobs to the point that it starts with. effects: the valid
  /// names beside the empty one. Usage error as of Renderer::set_budget; then nothing has changed.
  [[nodiscard]] Status set(FrameBudget budget, std::span<const std::string> effects, KnobRegistry& knobs);
  /// Changes the time and the locked knobs of an effect's budget. Usage error as of Renderer::change_budget; then
  /// nothing has changed.
  [[nodiscard]] Status change(std::string_view effect, double ms, std::vector<std::string> locked, KnobRegistry& knobs);
  void clear(std::string_view effect);
  [[nodiscard]] bool empty() const { return controls_.empty(); }
  /// nullptr without a budget of this effect.
  [[nodiscard]] BudgetControl* find(std::string_view effect);
  [[nodiscard]] std::vector<BudgetState> states() const;

 private:
  /// Usage error if another budget sets a knob of this one.
  [[nodiscard]] Status check_shared(const BudgetControl& control) const;

  std::vector<BudgetControl> controls_;
};

}  // namespace gloam
