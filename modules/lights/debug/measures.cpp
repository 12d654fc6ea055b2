// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/debug/measures.h"

#include <cmath>
#include <string>
#include <utility>

#include "modules/lights/knobs.h"
#include "modules/lights/outputs.h"

namespace gloam {
namespace {

std::optional<double> counter(const FrameCounters& counters, const char* name) {
  const auto found = counters.find(name);
  return found == counters.end() ? std::nullopt : std::optional(found->second);
}

/// A counter minus the exact count; none if either was not counted (culling is off, or the frame shows no surface).
std::optional<double> beyond_exact(const std::optional<double>& lights, const FrameCounters& counters) {
  const auto exact = counter(counters, "lights.per_tile_accurate_mean");
  if (!lights || !exact) return std::nullopt;
  return *lights - *exact;
}

std::optional<double> candidates_beyond_exact(const FrameCounters& frame, const FrameCounters&) {
  return beyond_exact(counter(frame, "lights.per_tile_candidates_mean"), frame);
}

/// Tiled shading loops over the exact lists, brute-force shading over every local light. The exact count comes from the
/// tiled frame in both cases.
std::optional<double> shaded_beyond_exact(const FrameCounters& frame, const FrameCounters& tiled) {
  const auto listed = counter(frame, "lights.per_tile_accurate_mean");
  return beyond_exact(listed ? listed : counter(frame, "lights.local"), tiled);
}

std::string lost_lights(const FrameCounters& frame) {
  const double errors = counter(frame, "lights.culling_errors").value_or(0.0);
  const double violations = counter(frame, "lights.capacity_violations").value_or(0.0);
  if (errors > 0.0)
    return std::to_string(std::llround(errors)) + " times a pixel is in range of a light that its tile's list lacks";
  if (violations > 0.0) return std::to_string(std::llround(violations)) + " lights found no room in their tile's list";
  return {};
}

}  // namespace

std::vector<MeasureInfo> light_measures() {
  std::vector<MeasureInfo> measures;
  const auto add = [&](const auto& knob, auto error) {
    MeasureInfo info;
    info.knob = knob.name;
    info.kind = "brute force";
    info.name = "exact per-pixel lists; pictures against lights.culling=brute";
    info.unit = "false positives a tile";
    info.judged_with = {override_of(kLightCheck, true)};
    info.picture = {override_of(kLightCulling, LightCulling::brute)};
    info.error = error;
    info.fault = &lost_lights;
    measures.push_back(std::move(info));
  };
  add(kLightCulling, &shaded_beyond_exact);
  add(kLightTileBound, &candidates_beyond_exact);
  add(kLightZBins, &candidates_beyond_exact);
  return measures;
}

}  // namespace gloam
