// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/grass/probe.h"

#include <cstring>
#include <string_view>
#include <utility>

#include "engine/render/frame_builder.h"
#include "modules/grass/frame.h"

namespace gloam {
namespace {

template <class T>
std::vector<T> items_of(const Captures& copies, std::string_view name) {
  const std::span<const std::byte> bytes = copies.bytes(name);
  std::vector<T> items(bytes.size() / sizeof(T));
  if (!items.empty()) std::memcpy(items.data(), bytes.data(), items.size() * sizeof(T));
  return items;
}

}  // namespace

void GrassProbe::add_passes(FrameBuilder& frame, PassPhase phase) {
  if (phase != PassPhase::visualize) return;
  steps_ = {};
  const auto* grass = frame.find<std::shared_ptr<GrassFrame>>();
  if (grass == nullptr || (*grass)->stored.patches.empty()) return;
  steps_ = (*grass)->steps;
  if (!std::exchange(wanted_, false)) return;
  reading_ = {.patches = (*grass)->stored.patches, .range_m = (*grass)->lod.range_m};
  copies_ = std::make_unique<Captures>(frame.services().device);
  const auto copy = [&](std::string_view name, BufferRef buffer) {
    static_cast<void>(frame.check(copies_->add(frame.graph(), name, buffer)));
  };
  copy("draws", (*grass)->sorted.draws);
  copy("blades", (*grass)->sorted.blades);
  copy("bins", (*grass)->sorted.bins);
  copy("knots", (*grass)->stored.store.knots);
  copy("poses", (*grass)->drawn.poses);
}

GrassReading GrassProbe::take() {
  if (copies_ == nullptr) return {};
  copies_->finish();
  reading_.draws = copies_->item<shaders::GrassDraws>("draws", 0);
  reading_.blades = items_of<std::uint32_t>(*copies_, "blades");
  reading_.blades.resize(reading_.draws.live);
  reading_.bins = items_of<std::uint32_t>(*copies_, "bins");
  reading_.knots = items_of<vec4>(*copies_, "knots");
  reading_.poses = items_of<shaders::GrassPose>(*copies_, "poses");
  reading_.poses.resize(reading_.draws.live);
  copies_.reset();
  return std::exchange(reading_, {});
}

}  // namespace gloam
