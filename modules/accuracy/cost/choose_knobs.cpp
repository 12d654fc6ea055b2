// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "engine/core/text/nearest_name.h"
#include "modules/accuracy/module.h"

namespace gloam {

namespace {

/// Whether a name is one that a pattern stands for: `*` stands for any characters.
bool matches(std::string_view name, std::string_view pattern) {
  std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return name == pattern;
  if (!name.starts_with(pattern.substr(0, star))) return false;
  name.remove_prefix(star);
  while (true) {
    pattern.remove_prefix(star + 1);
    star = pattern.find('*');
    if (star == std::string_view::npos) return name.ends_with(pattern);
    // The first place for the part between two stars leaves the most for the rest.
    const std::size_t place = name.find(pattern.substr(0, star));
    if (place == std::string_view::npos) return false;
    name.remove_prefix(place + star);
  }
}

}  // namespace

Result<std::vector<std::string>> choose_knobs(const KnobRegistry& knobs, std::string_view list) {
  std::vector<std::string> names;
  for (const Knob& knob : knobs.knobs()) names.push_back(knob.name);
  if (list.empty()) return names;
  std::vector<std::string> chosen;
  while (true) {
    const std::size_t comma = std::min(list.find(','), list.size());
    const std::string pattern(list.substr(0, comma));
    bool found = false;
    for (const std::string& name : names) {
      if (!matches(name, pattern)) continue;
      found = true;
      if (std::find(chosen.begin(), chosen.end(), name) == chosen.end()) chosen.push_back(name);
    }
    if (!found) return Error{ErrorKind::usage, "unknown knob '" + pattern + "'; " + valid_names(pattern, names)};
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
