// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "engine/core/text/nearest_name.h"
#include "modules/accuracy/module.h"

namespace gloam {

Result<std::vector<std::string>> choose_knobs(const KnobRegistry& knobs, std::string_view list) {
  std::vector<std::string> names;
  for (const Knob& knob : knobs.knobs()) names.push_back(knob.name);
  if (list.empty()) return names;
  std::vector<std::string> chosen;
  while (true) {
    const std::size_t comma = std::min(list.find(','), list.size());
    const std::string name(list.substr(0, comma));
    if (knobs.find(name) == nullptr)
      return Error{ErrorKind::usage, "unknown knob '" + name + "'; " + valid_names(name, names)};
    if (std::find(chosen.begin(), chosen.end(), name) == chosen.end()) chosen.push_back(name);
    if (comma == list.size()) return chosen;
    list.remove_prefix(comma + 1);
  }
}

std::vector<std::string> ledger_values(const Knob& knob) {
  if (knob.type == Knob::Type::choice && knob.ledger_values.empty()) return knob.choices;
  const std::string standard = value_text(knob, knob.default_number);
  std::vector<std::string> values;
  const auto add = [&values](const std::string& value) {
    if (!value.empty() && std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  };
  for (const double value : knob.ledger_values) add(value_text(knob, value));
  add(standard);
  add(knob.exact);
  return values;
}

}  // namespace gloam
