// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

/// The knobs by module, modules in the order of their first knobs.
std::vector<const Knob*> by_module(const KnobRegistry& registry) {
  std::vector<const Knob*> knobs;
  std::vector<std::string> modules;
  for (const Knob& knob : registry.knobs()) {
    knobs.push_back(&knob);
    if (std::ranges::find(modules, knob.module) == modules.end()) modules.push_back(knob.module);
  }
  std::ranges::stable_sort(knobs, {}, [&](const Knob* knob) { return std::ranges::find(modules, knob->module); });
  return knobs;
}

std::string text_of(const KnobRegistry& registry) {
  std::string text, module;
  for (const Knob* own : by_module(registry)) {
    const Knob& knob = *own;
    if (knob.module != module) text += (module.empty() ? "" : "\n") + knob.module + "\n";
    module = knob.module;
    text += "  " + knob.name + "=" + registry.text(knob) + "  (" + values_text(knob) + ")\n      " + knob.meaning;
    text += knob.exact.empty() ? "\n" : "; exact: " + knob.exact + "\n";
  }
  return text;
}

Json json_of(const KnobRegistry& registry) {
  Json json = {{"version", 1}, {"knobs", Json::array()}};
  for (const Knob& knob : registry.knobs()) {
    Json row = {
        {"name", knob.name}, {"module", knob.module},        {"meaning", knob.meaning},
        {"unit", knob.unit}, {"value", registry.text(knob)}, {"default", value_text(knob, knob.default_number)}};
    if (knob.type == Knob::Type::choice)
      row["values"] = knob.choices;
    else
      row["min"] = knob.min, row["max"] = knob.max;
    if (!knob.exact.empty()) row["exact"] = knob.exact;
    if (!knob.taste.empty()) row["taste"] = knob.taste;
    if (!knob.only_with.empty()) row["only_with"] = knob.only_with;
    json["knobs"].push_back(std::move(row));
  }
  return json;
}

/// Text for a cell of a table.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}
std::string code(const std::string& text) { return text.empty() ? text : "`" + cell(text) + "`"; }

/// The page docs/knobs.md. It shows defaults, not the current values.
std::string markdown_of(const KnobRegistry& registry) {
  std::string text =
      "# Knobs\n\n"
      "A knob trades accuracy for time, or chooses a method. The program sets knobs with `--set NAME=VALUE` and "
      "`--config\n"
      "FILE`, a host with `Renderer::knobs().set(…)` and, for one view, `ViewSettings::knobs`. *Exact* is the value "
      "that\n"
      "`gloam cost` compares the other values with. `gloam play` and `gloam render` set "
      "`lighting.antialiasing=smaa`,\n"
      "and `gloam play` sets `views.range=fit` and `reflections.recapture=budget`. `scene.default_light` and "
      "`views.range`\n"
      "are knobs of the program alone.\n\n"
      "This page is the output of `gloam knobs --markdown`; the tests compare it.\n";
  std::string module;
  for (const Knob* own : by_module(registry)) {
    const Knob& knob = *own;
    if (knob.module != module)
      text += "\n## " + knob.module +
              "\n\n| Knob | Values | Default | Exact | Meaning |\n| --- | --- | --- | --- | --- |\n";
    module = knob.module;
    std::string values;
    if (knob.type == Knob::Type::choice)
      for (const std::string& choice : knob.choices) values += (values.empty() ? "" : ", ") + code(choice);
    else
      values = value_text(knob, knob.min) + " … " + value_text(knob, knob.max);
    if (!knob.unit.empty()) values += " " + cell(knob.unit);
    text += "| " + code(knob.name) + " | " + values + " | " + code(value_text(knob, knob.default_number)) + " | " +
            code(knob.exact) + " | " + cell(knob.meaning) + " |\n";
  }
  return text;
}

std::string output_of(const KnobRegistry& registry, const Options& options) {
  if (options.markdown) return markdown_of(registry);
  return options.json ? json_text(json_of(registry)) : text_of(registry);
}

}  // namespace

Status run_knobs(const CommandContext& context) {
  KnobRegistry registry = all_knobs(make_all_modules());
  GLOAM_TRY(set_knobs(registry, context.options));
  context.console.print(output_of(registry, context.options));
  return {};
}

}  // namespace gloam
