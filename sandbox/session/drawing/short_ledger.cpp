// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/drawing/short_ledger.h"

#include <algorithm>
#include <string>

#include "modules/accuracy/module.h"
#include "sandbox/session/drawing/session_costs.h"
#include "sandbox/session/loading/ledger_header.h"

namespace gloam {
namespace {

/// What each effect does without first, and misses least.
const std::vector<KnobOverride> kSavings = {{"shadows.filter", "hard"},       {"shadows.texels_per_pixel", "1"},
                                            {"closeups.max_pairs", "0"},      {"reflections.tiers", "cube"},
                                            {"lighting.antialiasing", "off"}, {"particles.lighting", "sprite"},
                                            {"grass.lod_pixels", "2"},        {"grass.cast_distance", "2"}};

std::vector<KnobOverride> with_scale(std::vector<KnobOverride> settings, const char* scale) {
  settings.push_back({"views.scale", scale});
  return settings;
}

}  // namespace

std::vector<std::vector<KnobOverride>> usual_settings(const Options& options) {
  std::vector<std::vector<KnobOverride>> all = {
      with_scale(kSavings, "0.35"), with_scale({}, "0.7"),  with_scale(kSavings, "0.5"), with_scale({}, "0.5"),
      with_scale(kSavings, "0.7"),  with_scale({}, "0.85"), with_scale({}, "0.35"),      kSavings};
  for (std::vector<KnobOverride>& settings : all)
    std::erase_if(settings, [&](const KnobOverride& setting) {
      return std::ranges::any_of(options.assignments,
                                 [&](const std::string& set) { return set.starts_with(setting.name + "="); });
    });
  return all;
}

Result<Ledger> measure_session_shortly(Session& session, const Options& options,
                                       const std::function<Status(std::size_t done, std::size_t total)>& progress) {
  Options own = options;
  own.out.clear();  // nothing is written
  SessionCosts costs(session, own);
  return measure_short_ledger(
      {.header = ledger_header(session, own), .settings = usual_settings(own), .progress = progress}, costs);
}

}  // namespace gloam
