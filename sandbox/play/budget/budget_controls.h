// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/render/renderer.h"
#include "sandbox/window/panel_budget.h"

namespace gloam {

/// A budget and its knobs as the panel shows them.
[[nodiscard]] PanelBudget panel_budget(const BudgetState& state, const KnobRegistry& knobs);

/// The governed knobs of all budgets, each with its value in its budget's most exact setting.
[[nodiscard]] std::vector<KnobOverride> exact_settings(const std::vector<BudgetState>& budgets);

/// Carries out the user's changes to the renderer's budgets. A governed knob that the user changes is locked, because
/// the budget would undo the change.
class BudgetControls {
 public:
  /// The renderer must outlive it.
  explicit BudgetControls(Renderer& renderer) : renderer_(renderer) {}

  /// Call it before the user can change anything: takes up the state of all budgets and the values of their knobs.
  void begin();
  /// As of begin(), in the order of Renderer::budgets.
  [[nodiscard]] const std::vector<PanelBudget>& budgets() const { return shown_; }
  /// index: of budgets().
  void set_ms(std::size_t index, double ms);
  void lock(std::size_t index, const std::string& knob, bool locked);
  /// Call it after the user could change knobs: locks the governed ones that differ from their values in begin().
  void end();

  /// Why the last change was refused; empty: it was not.
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  void change(std::size_t index, double ms, std::vector<std::string> locked);
  void note_values();

  Renderer& renderer_;
  std::vector<BudgetState> states_;
  std::vector<PanelBudget> shown_;
  std::vector<std::vector<std::string>> values_;  ///< of BudgetState::governed, for each budget
  std::string fault_;
};

}  // namespace gloam
