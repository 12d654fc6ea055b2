// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/display/reduced_knobs.h"

#include <algorithm>
#include <string>

namespace gloam {
namespace {

constexpr double kFullFrom = 0.5;    // scale
constexpr double kLeastShare = 0.5;  // of the default density of maps

}  // namespace

std::vector<KnobOverride> knobs_at_scale(const KnobRegistry& knobs, double scale) {
  std::vector<KnobOverride> reduced;
  if (scale >= kFullFrom) return reduced;
  const auto reduce = [&](const char* name, auto&& text) {
    const Knob* knob = knobs.find(name);
    if (knob != nullptr && knobs.number(*knob) == knob->default_number) reduced.push_back({name, text(*knob)});
  };
  reduce("shadows.texels_per_pixel", [&](const Knob& knob) {
    return value_text(knob, std::max(scale / kFullFrom, kLeastShare) * knob.default_number);
  });
  reduce("shadows.near_directions", [](const Knob&) { return std::string("8"); });
  return reduced;
}

}  // namespace gloam
