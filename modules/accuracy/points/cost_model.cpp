// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/points/cost_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "modules/accuracy/points/knapsack.h"

namespace gloam {
namespace {

/// Predicted times of many changes may add up to less than nothing.
constexpr double kLeastRatio = 0.01;

/// Mean FLIP. Smaller differences count as none: otherwise a value that nobody can tell from the default would be part
/// of every combination.
constexpr double kLeastDifference = 1e-4;

double squared_error_of(const LedgerRow& row) { return row.whole->flip.mean * row.whole->flip.mean; }

/// The row that the others of the knob are compared with: that of the user's value, or else of the default.
const LedgerRow* users_row(const std::vector<const LedgerRow*>& rows, const std::string& users) {
  const auto own = std::ranges::find(rows, users, &LedgerRow::value);
  if (own != rows.end()) return *own;
  const auto standard = std::ranges::find_if(rows, &LedgerRow::is_default);
  return standard != rows.end() ? *standard : nullptr;
}

CostModel::Option option_of(const LedgerRow& row, const LedgerRow& base) {
  const bool significant = row.ratio_high < base.ratio || row.ratio_low > base.ratio;
  const bool visible = std::abs(row.whole->flip.mean - base.whole->flip.mean) >= kLeastDifference;
  return {row.value,
          {.ratio = significant ? (row.ratio - base.ratio) / base.ratio : 0.0,
           .squared_error = visible ? squared_error_of(row) - squared_error_of(base) : 0.0}};
}

}  // namespace

double Cost::error() const { return std::sqrt(std::max(squared_error, 0.0)); }

CostModel::CostModel(const std::vector<LedgerRow>& rows, const KnobRegistry& knobs) {
  for (const Knob& knob : knobs.knobs()) {
    std::vector<const LedgerRow*> own;
    for (const LedgerRow& row : rows)
      if (row.knob == knob.name && row.whole && row.ratio > 0.0) own.push_back(&row);
    const std::string users = knobs.text(knob);
    const LedgerRow* base = users_row(own, users);
    if (base == nullptr || knob.is_look) continue;
    // The user's settings are the same for all knobs, and so is their error.
    if (base->value == users) users_squared_error_ = squared_error_of(*base);
    VariedKnob varied = {.name = knob.name, .options = {{users, {.ratio = 0.0}}}};
    for (const LedgerRow* row : own)
      if (row->value != users && row->wrong.empty() && !row->no_effect)
        varied.options.push_back(option_of(*row, *base));
    if (varied.options.size() > 1) knobs_.push_back(std::move(varied));
  }
}

Cost CostModel::added_by(const VariedKnob& knob, const Changes& changes) const {
  const auto change = changes.find(knob.name);
  if (change == changes.end()) return knob.options.front().added;
  const auto option = std::ranges::find(knob.options, change->second, &Option::value);
  return option != knob.options.end() ? option->added : knob.options.front().added;
}

Cost CostModel::predict(const Changes& changes) const {
  Cost cost = {.ratio = 1.0, .squared_error = users_squared_error_};
  for (const VariedKnob& knob : knobs_) {
    const Cost added = added_by(knob, changes);
    cost.ratio += added.ratio;
    cost.squared_error += added.squared_error;
  }
  cost.ratio = std::max(cost.ratio, kLeastRatio);
  return cost;
}

Cost CostModel::predict_from(const Cost& measured, const Changes& changes, const VariedKnob& knob,
                             const Option& option) const {
  const Cost now = added_by(knob, changes);
  return {.ratio = std::max(measured.ratio + option.added.ratio - now.ratio, kLeastRatio),
          .squared_error = measured.squared_error + option.added.squared_error - now.squared_error};
}

std::vector<Changes> CostModel::front() const {
  std::vector<std::vector<KnapsackOption>> groups;
  for (const VariedKnob& knob : knobs_) {
    std::vector<KnapsackOption>& group = groups.emplace_back();
    for (const Option& option : knob.options) group.push_back({option.added.ratio, option.added.squared_error});
  }
  std::vector<Changes> front;
  for (const Combination& combination : undominated_combinations(groups)) {
    Changes& changes = front.emplace_back();
    for (std::size_t i = 0; i < knobs_.size(); ++i)
      changes = changed(std::move(changes), knobs_[i], knobs_[i].options[combination.chosen[i]]);
  }
  return front;
}

Changes changed(Changes changes, const CostModel::VariedKnob& knob, const CostModel::Option& option) {
  changes.erase(knob.name);
  if (&option != &knob.options.front()) changes.emplace(knob.name, option.value);
  return changes;
}

}  // namespace gloam
