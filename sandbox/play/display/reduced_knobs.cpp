// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/display/reduced_knobs.h"

#include <algorithm>

namespace gloam {
namespace {

constexpr const char* kMapDensity = "shadows.texels_per_pixel";
constexpr double kFullDensityFrom = 0.5;  // scale
constexpr double kLeastShare = 0.5;       // of the default density

}  // namespace

std::vector<KnobOverride> knobs_at_scale(const KnobRegistry& knobs, double scale) {
  const Knob* density = knobs.find(kMapDensity);
  if (density == nullptr || scale >= kFullDensityFrom || knobs.number(*density) != density->default_number) return {};
  const double share = std::max(scale / kFullDensityFrom, kLeastShare);
  return {{kMapDensity, value_text(*density, share * density->default_number)}};
}

}  // namespace gloam
