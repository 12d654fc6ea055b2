// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/program_knobs.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "sandbox/output/file_io.h"

namespace gloam {
namespace {

constexpr std::string_view kRange = "views.range";
constexpr std::string_view kFit = "fit";

/// Of a choice of views.range; 0: it is none.
float factor_of(std::string_view choice) {
  if (choice == kFit) return 0.0f;
  const std::string text(choice);
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return std::stof(text);
  return std::stof(text.substr(0, slash)) / std::stof(text.substr(slash + 1));
}

}  // namespace

void add_program_knobs(KnobRegistry& knobs) {
  Knob light;
  light.name = "scene.default_light";
  light.module = "scene";
  light.meaning =
      "a soft sky and a low sun for a scene that has neither a light nor a sky; read when a scene is loaded";
  light.choices = {"on", "off"};
  knobs.add(std::move(light));
  Knob range;
  range.name = std::string(kRange);
  range.module = "views";
  range.meaning =
      "factor on the value at the end of the colour scales of views; fit: the smallest one that fits what is shown; "
      "play sets fit";
  range.choices = {"1", std::string(kFit), "1/16", "1/8", "1/4", "1/2", "2", "4", "8", "16"};
  knobs.add(std::move(range));
}

float heat_range(const KnobRegistry& knobs) {
  if (knobs.find(kRange) == nullptr) return 1.0f;
  const float factor = factor_of(knobs.text(kRange));
  return factor > 0.0f ? factor : 1.0f;
}

bool fits_heat_range(const KnobRegistry& knobs) { return knobs.find(kRange) != nullptr && knobs.is(kRange, kFit); }

std::vector<float> heat_ranges(const KnobRegistry& knobs) {
  std::vector<float> factors;
  if (const Knob* range = knobs.find(kRange); range != nullptr)
    for (const std::string& choice : range->choices)
      if (const float factor = factor_of(choice); factor > 0.0f) factors.push_back(factor);
  std::ranges::sort(factors);
  return factors;
}

KnobRegistry all_knobs(const ModuleList& modules) {
  KnobRegistry knobs;
  for (const auto& module : modules) module->knobs(knobs);
  add_program_knobs(knobs);
  return knobs;
}

Status set_knobs(KnobRegistry& knobs, const Options& options) {
  // Pictures for users are antialiased. Measurements compare pictures as they were drawn.
  if (options.command == Command::play || options.command == Command::render)
    GLOAM_TRY(knobs.set("lighting.antialiasing", "smaa"));
  if (options.command == Command::play) GLOAM_TRY(knobs.set(kRange, kFit));
  if (!options.config.empty()) {
    const auto text = read_text_file(options.config, ErrorKind::usage);
    if (!text) return text.error();
    GLOAM_TRY(knobs.set_from_json(*text, options.config));
  }
  for (const std::string& assignment : options.assignments) GLOAM_TRY(knobs.set_assignment(assignment));
  return {};
}

}  // namespace gloam
