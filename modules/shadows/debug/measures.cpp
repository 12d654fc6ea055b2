// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/measures.h"

#include <string>
#include <utility>

#include "modules/shadows/knobs.h"
#include "modules/shadows/outputs.h"

namespace gloam {
namespace {

/// The share of tile lights that are filtered; none without final lists or without lights.
std::optional<double> filtered_share(const FrameCounters& frame, const FrameCounters&) {
  const auto all = frame.find("shadows.tile_lights"), filtered = frame.find("shadows.tile_lights_filtered");
  if (all == frame.end() || filtered == frame.end() || all->second <= 0.0) return std::nullopt;
  return filtered->second / all->second;
}

std::string never_wrong(const FrameCounters&) { return {}; }

}  // namespace

std::vector<MeasureInfo> shadow_measures() {
  MeasureInfo info;
  info.knob = kShadowClassify.name;
  info.kind = "brute force";
  info.name = "all tile-light pairs filtered: shadows.classify=off";
  info.unit = "share of tile-light pairs asked pixel by pixel";
  info.judged_with = {override_of(kShadowMode, ShadowMode::deferred)};
  info.picture = {override_of(kShadowMode, ShadowMode::deferred), override_of(kShadowClassify, false)};
  info.error = &filtered_share;
  info.fault = &never_wrong;
  std::vector<MeasureInfo> measures;
  measures.push_back(std::move(info));
  return measures;
}

}  // namespace gloam
