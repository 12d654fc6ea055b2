// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>
#include <vector>

#include "modules/accuracy/module.h"
#include "modules/accuracy/points/cost_model.h"
#include "modules/accuracy/points/point_measurement.h"

namespace gloam {
namespace {

/// Times of one module have no intervals of their own; smaller differences count as none.
constexpr double kSureShare = 0.05;
/// Of the default's time: passes of an effect that is switched off take none, but only times above 0 can be scaled.
constexpr double kLeastShare = 1e-3;
/// A point is left out if it is not slower than the last one by this factor.
constexpr double kLeastStep = 1.04;

/// The rows of the module's knobs, with ratios of the time of its passes.
std::vector<LedgerRow> rows_of_effect(const Ledger& ledger, std::string_view effect, const KnobRegistry& knobs,
                                      double& default_ms) {
  std::vector<LedgerRow> rows;
  for (const LedgerRow& row : ledger.rows) {
    const Knob* knob = knobs.find(row.knob);
    if (knob == nullptr || knob->module != effect || knob->scales_frame) continue;
    rows.push_back(row);
    if (row.is_default) default_ms = std::max(default_ms, row.module_gpu_ms);
  }
  for (LedgerRow& row : rows) {
    const auto own =
        std::ranges::find_if(rows, [&](const LedgerRow& other) { return other.knob == row.knob && other.is_default; });
    const double base = own == rows.end() ? default_ms : own->module_gpu_ms;
    row.ratio = base > 0.0 ? std::max(row.module_gpu_ms / base, kLeastShare) : 1.0;
    row.ratio_low = row.ratio - kSureShare;
    row.ratio_high = row.ratio + kSureShare;
    if (row.is_default) row.ratio = 1.0;
    row.no_effect = row.no_effect && !row.is_default;
  }
  return rows;
}

}  // namespace

std::vector<FrontPoint> effect_points(const Ledger& ledger, std::string_view effect, KnobRegistry knobs) {
  for (const Knob& knob : knobs.knobs()) knobs.set_number(knob, knob.default_number);
  double default_ms = 0.0;
  const std::vector<LedgerRow> rows = rows_of_effect(ledger, effect, knobs, default_ms);
  if (!(default_ms > 0.0)) return {};
  const CostModel model(rows, knobs);
  const std::vector<Changes> front = model.front();
  std::vector<FrontPoint> points;
  for (std::size_t i = 0; i < front.size(); ++i) {
    const Cost cost = model.predict(front[i]);
    FrontPoint point = {.ms = default_ms * cost.ratio, .error = cost.error(), .settings = {}};
    if (!points.empty() && point.ms < kLeastStep * points.back().ms) {
      if (i + 1 < front.size()) continue;
      if (points.size() > 1) points.pop_back();  // the most exact point stays
    }
    for (KnobValue& setting : settings_with(knobs, front[i]))
      point.settings.push_back({std::move(setting.knob), std::move(setting.value)});
    points.push_back(std::move(point));
  }
  return points;
}

}  // namespace gloam
