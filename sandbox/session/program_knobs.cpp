// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/program_knobs.h"

#include <string>
#include <string_view>
#include <utility>

#include "sandbox/output/file_io.h"

namespace gloam {
namespace {

constexpr std::string_view kRange = "views.range";

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
  range.meaning = "factor on the value at the end of the colour scales of views";
  range.choices = {"1", "1/16", "1/8", "1/4", "1/2", "2", "4", "8", "16"};
  knobs.add(std::move(range));
}

float heat_range(const KnobRegistry& knobs) {
  if (knobs.find(kRange) == nullptr) return 1.0f;
  const std::string text = knobs.text(kRange);
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return std::stof(text);
  return std::stof(text.substr(0, slash)) / std::stof(text.substr(slash + 1));
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
  if (!options.config.empty()) {
    const auto text = read_text_file(options.config, ErrorKind::usage);
    if (!text) return text.error();
    GLOAM_TRY(knobs.set_from_json(*text, options.config));
  }
  for (const std::string& assignment : options.assignments) GLOAM_TRY(knobs.set_assignment(assignment));
  return {};
}

}  // namespace gloam
