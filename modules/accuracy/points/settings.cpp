// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "modules/accuracy/outputs.h"

namespace gloam {

std::vector<FrontPoint> front_points(const Ledger& ledger) {
  std::vector<FrontPoint> points;
  for (const LedgerPoint& measured : ledger.points) {
    if (!measured.measured.flip) continue;
    FrontPoint& point = points.emplace_back();
    point.ms = measured.measured.ms.median_ms;
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
