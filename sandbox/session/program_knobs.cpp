// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/program_knobs.h"

#include <utility>

#include "sandbox/output/file_io.h"

namespace gloam {

void add_program_knobs(KnobRegistry& knobs) {
  Knob light;
  light.name = "scene.default_light";
  light.module = "scene";
  light.meaning =
      "a soft sky and a low sun for a scene that has neither a light nor a sky; read when a scene is loaded";
  light.choices = {"on", "off"};
  knobs.add(std::move(light));
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
