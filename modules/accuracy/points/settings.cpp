// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "modules/accuracy/outputs.h"

namespace gloam {

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
