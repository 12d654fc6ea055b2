// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <nlohmann/json.hpp>

#include "modules/accuracy/outputs.h"

namespace gloam {

namespace {

/// What a clock on the wall shows over the ledger's: the median of all points, so that ratios of times stay.
double wall_over_ledger(const Ledger& ledger) {
  std::vector<double> ratios;
  for (const LedgerPoint& point : ledger.points)
    if (point.measured.ms.median_ms > 0.0 && point.measured.wall_ms > 0.0)
      ratios.push_back(point.measured.wall_ms / point.measured.ms.median_ms);
  if (ratios.empty()) return 1.0;
  std::ranges::sort(ratios);
  return ratios[ratios.size() / 2];
}

}  // namespace

std::vector<FrontPoint> front_points(const Ledger& ledger) {
  const double scale = wall_over_ledger(ledger);
  std::vector<FrontPoint> points;
  for (const LedgerPoint& measured : ledger.points) {
    if (!measured.measured.flip) continue;
    FrontPoint& point = points.emplace_back();
    point.ms = scale * measured.measured.ms.median_ms;
    point.error = measured.measured.flip->mean;
    for (const KnobValue& setting : measured.settings) point.settings.push_back({setting.knob, setting.value});
  }
  return points;
}

std::string settings_text(const std::vector<KnobValue>& settings) {
  std::string text;
  for (const KnobValue& setting : settings) text += (text.empty() ? "" : " ") + setting.knob + "=" + setting.value;
  return text.empty() ? "default" : text;
}

std::string settings_config(const std::vector<KnobValue>& settings) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const KnobValue& setting : settings) json[setting.knob] = setting.value;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace gloam
