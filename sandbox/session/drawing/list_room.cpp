// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/drawing/list_room.h"

#include <algorithm>
#include <string>
#include <utility>

namespace gloam {
namespace {

constexpr int kMostFramesMore = 10;
constexpr int kFramesInVain = 3;  // frames until a change of the buffers shows in the counters

double overflowing_tiles(const FrameReport& report) {
  double tiles = 0.0;
  for (const char* counter : {"shadows.fallback_tiles", "lights.overflow_tiles"}) {
    const auto found = report.counters.find(counter);
    if (found != report.counters.end()) tiles += found->second;
  }
  return tiles;
}

}  // namespace

bool shows_lists(const Renderer& renderer, std::string_view name) {
  const std::string_view stem = name.substr(0, name.find(':'));
  for (const VisualizerInfo& info : renderer.visualizers())
    if (info.name == stem) return info.shows_lists;
  return false;
}

Status draw_until_lists_fit(const std::function<Result<FrameSample>()>& draw, FrameSample& last) {
  double least = overflowing_tiles(last.report);
  int in_vain = 0;
  for (int i = 0; i < kMostFramesMore && in_vain < kFramesInVain && overflowing_tiles(last.report) > 0.0; ++i) {
    auto sample = draw();
    if (!sample) return sample.error();
    last = std::move(sample).value();
    const double now = overflowing_tiles(last.report);
    in_vain = now < least ? 0 : in_vain + 1;
    least = std::min(least, now);
  }
  return {};
}

}  // namespace gloam
