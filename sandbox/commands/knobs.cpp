// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "modules/module_list/module_list.h"
#include "sandbox/commands/commands.h"
#include "sandbox/output/json_text.h"
#include "sandbox/session/program_knobs.h"

namespace gloam {
namespace {

/// The values that a knob takes: "on | off", or "1 … 16 pixels".
std::string values_text(const Knob& knob) {
  if (knob.type != Knob::Type::choice) {
    const std::string unit = knob.unit.empty() ? "" : " " + knob.unit;
    return value_text(knob, knob.min) + " … " + value_text(knob, knob.max) + unit;
  }
  std::string text;
  for (const std::string& choice : knob.choices) text += (text.empty() ? "" : " | ") + choice;
  return text;
}

std::string text_of(const KnobRegistry& registry) {
  std::string text, module;
  for (const Knob& knob : registry.knobs()) {
    if (knob.module != module) text += (module.empty() ? "" : "\n") + knob.module + "\n";
    module = knob.module;
    text += "  " + knob.name + "=" + registry.text(knob.name) + "  (" + values_text(knob) + ")\n      " + knob.meaning;
    text += knob.exact.empty() ? "\n" : "; exact: " + knob.exact + "\n";
  }
  return text;
}

Json json_of(const KnobRegistry& registry) {
  Json json = {{"version", 1}, {"knobs", Json::array()}};
  for (const Knob& knob : registry.knobs()) {
    Json row = {{"name", knob.name},
                {"module", knob.module},
                {"meaning", knob.meaning},
                {"unit", knob.unit},
                {"value", registry.text(knob.name)},
                {"default", value_text(knob, knob.default_number)}};
    if (knob.type == Knob::Type::choice)
      row["values"] = knob.choices;
    else
      row["min"] = knob.min, row["max"] = knob.max;
    if (!knob.exact.empty()) row["exact"] = knob.exact;
    json["knobs"].push_back(std::move(row));
  }
  return json;
}

}  // namespace

Status run_knobs(const CommandContext& context) {
  KnobRegistry registry = all_knobs(make_all_modules());
  GLOAM_TRY(set_knobs(registry, context.options));
  context.console.print(context.options.json ? json_text(json_of(registry)) : text_of(registry));
  return {};
}

}  // namespace gloam
