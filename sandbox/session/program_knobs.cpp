// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/program_knobs.h"

#include <algorithm>

#include "engine/render/kept_frames/kept_frames.h"
#include "modules/lighting/outputs.h"
#include "modules/reflections/module.h"
#include "modules/shadows/outputs.h"
#include "sandbox/output/file_io.h"

namespace gloam {

void add_program_knobs(KnobRegistry& knobs) {
  add_knobs(knobs, "scene", kDefaultLight);
  add_knobs(knobs, "views", kHeatRange);
}

float heat_range(const KnobRegistry& knobs) {
  const float factor = knobs.try_value(kHeatRange).value_or(1.0f);
  return factor > 0.0f ? factor : 1.0f;
}

double view_scale(const KnobRegistry& knobs) { return knobs.try_value(kViewScale).value_or(1.0); }

bool fits_heat_range(const KnobRegistry& knobs) { return knobs.try_value(kHeatRange) == kFitHeatRange; }

std::vector<float> heat_ranges(const KnobRegistry& knobs) {
  std::vector<float> factors;
  if (!knobs.try_value(kHeatRange)) return factors;
  for (const KnobChoice<float>& choice : kHeatRange.choices)
    if (choice.value > 0.0f) factors.push_back(choice.value);
  std::ranges::sort(factors);
  return factors;
}

KnobRegistry all_knobs(const ModuleList& modules) {
  KnobRegistry knobs;
  for (const auto& module : modules) module->knobs(knobs);
  add_renderer_knobs(knobs);
  add_program_knobs(knobs);
  return knobs;
}

Status set_knobs(KnobRegistry& knobs, const Options& options) {
  // Pictures for users are antialiased. Measurements compare pictures as they were drawn.
  if (options.command == Command::play || options.command == Command::render)
    knobs.set(kAntialiasing, Antialiasing::smaa);
  // What is measured at rest is what moving cameras pay.
  if (options.command == Command::cost || options.command == Command::bench) {
    knobs.set(kFrameReuse, FrameReuse::off);
    knobs.set(kShadowReuse, ShadowReuse::off);
    knobs.set(kLightReuse, LightReuseKind::off);
  }
  if (options.command == Command::play) {
    knobs.set(kHeatRange, kFitHeatRange);
    // Pictures of render do not depend on the frames before them; a window follows its lamps.
    knobs.set(kReflectionRecapture, true);
  }
  if (!options.config.empty()) {
    const auto text = read_text_file(options.config, ErrorKind::usage);
    if (!text) return text.error();
    GLOAM_TRY(knobs.set_from_json(*text, options.config));
  }
  for (const std::string& assignment : options.assignments) GLOAM_TRY(knobs.set_assignment(assignment));
  return {};
}

}  // namespace gloam
