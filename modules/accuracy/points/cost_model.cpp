// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/points/cost_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "engine/core/assert.h"
#include "engine/render/kept_frames/kept_frames.h"
#include "modules/accuracy/points/knapsack.h"
#include "modules/lighting/outputs.h"
#include "modules/shadows/outputs.h"

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

/// The combinations for which no other one is predicted to be as fast and as right, the fastest first.
std::vector<Changes> undominated(const CostModel& model, std::vector<Changes> all) {
  std::vector<std::pair<Cost, Changes>> sorted;
  for (Changes& changes : all) {
    const Cost cost = model.predict(changes);
    sorted.emplace_back(cost, std::move(changes));
  }
  std::ranges::stable_sort(sorted, [](const auto& a, const auto& b) {
    return std::tie(a.first.ratio, a.first.squared_error) < std::tie(b.first.ratio, b.first.squared_error);
  });
  std::vector<Changes> kept;
  double least = std::numeric_limits<double>::infinity();
  for (auto& [cost, changes] : sorted) {
    if (cost.squared_error >= least) continue;
    least = cost.squared_error;
    kept.push_back(std::move(changes));
  }
  return kept;
}

}  // namespace

double Cost::error() const { return std::sqrt(std::max(squared_error, 0.0)); }

bool reuses_last_frame(const Knob& knob) {
  return knob.name == kFrameReuse.name || knob.name == kShadowReuse.name || knob.name == kLightReuse.name;
}

CostModel::CostModel(const std::vector<LedgerRow>& rows, const KnobRegistry& knobs) : users_(knobs) {
  for (const Knob& knob : knobs.knobs()) {
    std::vector<const LedgerRow*> own;
    for (const LedgerRow& row : rows)
      if (row.knob == knob.name && row.whole && row.ratio > 0.0) own.push_back(&row);
    const std::string users = knobs.text(knob);
    const LedgerRow* base = users_row(own, users);
    if (base == nullptr || knob.is_look || reuses_last_frame(knob)) continue;
    // The user's settings are the same for all knobs, and so is their error.
    if (base->value == users) users_squared_error_ = squared_error_of(*base);
    VariedKnob varied = {.name = knob.name, .options = {{users, {.ratio = 0.0}}}, .scales_frame = knob.scales_frame};
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

double CostModel::scale(const Changes& changes) const {
  double scale = 1.0;
  for (const VariedKnob& knob : knobs_)
    if (knob.scales_frame) scale *= std::max(1.0 + added_by(knob, changes).ratio, kLeastRatio);
  return scale;
}

Changes CostModel::folded(Changes changes) const {
  KnobRegistry knobs = users_;
  for (const auto& [name, value] : changes) {
    const Status set = knobs.set(name, value);
    GLOAM_ASSERT(set.ok(), "a combination is of existing values");
  }
  std::erase_if(changes, [&](const auto& change) { return !knobs.unmet_setting(*knobs.find(change.first)).empty(); });
  return changes;
}

Cost CostModel::predict(const Changes& changes) const {
  Cost cost = {.ratio = 1.0, .squared_error = users_squared_error_};
  for (const VariedKnob& knob : knobs_) {
    const Cost added = added_by(knob, changes);
    if (!knob.scales_frame) cost.ratio += added.ratio;
    cost.squared_error += added.squared_error;
  }
  cost.ratio = std::max(cost.ratio, kLeastRatio) * scale(changes);
  return cost;
}

Cost CostModel::predict_from(const Cost& measured, const Changes& changes, const VariedKnob& knob,
                             const Option& option) const {
  const Cost now = added_by(knob, changes);
  const double ratio = knob.scales_frame ? measured.ratio * (1.0 + option.added.ratio) / (1.0 + now.ratio)
                                         : measured.ratio + (option.added.ratio - now.ratio) * scale(changes);
  return {.ratio = std::max(ratio, kLeastRatio),
          .squared_error = measured.squared_error + option.added.squared_error - now.squared_error};
}

std::vector<Changes> CostModel::candidates() const {
  std::vector<const VariedKnob*> adding;
  std::vector<std::vector<KnapsackOption>> groups;
  for (const VariedKnob& knob : knobs_) {
    if (knob.scales_frame) continue;
    adding.push_back(&knob);
    std::vector<KnapsackOption>& group = groups.emplace_back();
    for (const Option& option : knob.options) group.push_back({option.added.ratio, option.added.squared_error});
  }
  std::vector<Changes> all;
  for (const Combination& combination : undominated_combinations(groups)) {
    Changes& changes = all.emplace_back();
    for (std::size_t i = 0; i < adding.size(); ++i)
      changes = changed(std::move(changes), *adding[i], adding[i]->options[combination.chosen[i]]);
  }
  for (const VariedKnob& knob : knobs_) {
    if (!knob.scales_frame) continue;
    std::vector<Changes> scaled;
    for (const Changes& changes : all)
      for (const Option& option : knob.options) scaled.push_back(changed(changes, knob, option));
    all = std::move(scaled);
  }
  return undominated(*this, std::move(all));
}

std::vector<Changes> CostModel::front() const {
  std::vector<Changes> all = candidates();
  for (Changes& changes : all) changes = folded(std::move(changes));
  return undominated(*this, std::move(all));
}

Changes changed(Changes changes, const CostModel::VariedKnob& knob, const CostModel::Option& option) {
  changes.erase(knob.name);
  if (&option != &knob.options.front()) changes.emplace(knob.name, option.value);
  return changes;
}

}  // namespace gloam
