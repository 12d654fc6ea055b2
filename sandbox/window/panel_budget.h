// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gloam {

/// A knob that a budget sets, or would set if it were not locked.
struct PanelBudgetKnob {
  std::string name;
  std::string value;  ///< the present one
  bool locked = false;
};

/// A budget in the panel.
struct PanelBudget {
  std::string effect;  ///< empty: the budget of whole frames
  double ms = 0.0;
  std::string setting;     ///< "setting 4 of 9"
  std::string error;       ///< "error 0.021"
  std::string measured;    ///< "90 % of frames take at most 31.2 ms of 33"
  std::string down;        ///< what the next cheaper setting saves and costs
  std::string up;          ///< what the next better setting costs and gains
  std::string down_knobs;  ///< the knobs of that setting
  std::string up_knobs;
  std::string moved;  ///< why the budget chose another setting last
  std::vector<PanelBudgetKnob> knobs;
};

/// Facts about the budgets that the panel shows, and functions that carry out the user's changes. All functions are
/// set. Without a budget there is no section.
struct PanelBudgets {
  std::span<const PanelBudget> budgets;
  std::function<void(std::size_t budget, double ms)> set_ms;
  std::function<void(std::size_t budget, const std::string& knob, bool locked)> lock;
  std::string fault;  ///< why the last change was refused; empty: it was not

  /// None if no budget names the knob.
  [[nodiscard]] const PanelBudgetKnob* find(std::string_view knob) const;
};

}  // namespace gloam
