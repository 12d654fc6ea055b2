// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/closeup_passes.h"

#include <algorithm>

#include "modules/closeups/compose/composition.h"
#include "modules/closeups/compose/frame.h"
#include "modules/closeups/compose/overlay.h"
#include "modules/closeups/debug/unculled_pairs.h"
#include "modules/lights/outputs.h"
#include "shaders/closeups/closeups_shared.h"

namespace gloam {
namespace {

bool by_index(Entity a, Entity b) { return a.index < b.index; }

/// A pair with its map.
struct CloseupPlan {
  CloseupView pair;
  bool in_overlay = false;  ///< as in CloseupFrame
};

/// The pairs of the frame. Faces of a batch get one size, that of the largest one.
std::vector<CloseupPlan> plans_of(const CloseupFrame& closeups, std::uint32_t batch) {
  std::vector<CloseupPlan> plans;
  for (std::size_t i = 0; i < closeups.pairs.size(); ++i)
    plans.push_back({closeups.pairs[i], closeups.in_overlay[i] != 0});
  for (std::span<CloseupPlan> left = plans; !left.empty();) {
    const std::span<CloseupPlan> together = left.first(std::min<std::size_t>(batch, left.size()));
    left = left.subspan(together.size());
    std::uint32_t size = 0;
    for (const CloseupPlan& plan : together) size = std::max(size, plan.pair.face.square.size);
    for (CloseupPlan& plan : together) plan.pair.face.square.size = size;
  }
  return plans;
}

/// The first pairs, at most `most`, whose faces have one size, side by side in the close-up map.
std::vector<CloseupPlan> placed(std::span<const CloseupPlan> pairs, std::uint32_t most) {
  std::vector<CloseupPlan> plans;
  for (const CloseupPlan& plan : pairs) {
    const std::uint32_t size = pairs.front().pair.face.square.size, i = static_cast<std::uint32_t>(plans.size());
    if (i == most || plan.pair.face.square.size != size) break;
    plans.push_back(plan);
    plans.back().pair.face.square = {uvec2(i & 1u, i >> 1) * size, size};
  }
  return plans;
}

std::vector<ExtraMap> maps_of(const FrameBuilder& frame, std::span<const CloseupView> pairs) {
  const auto& subjects = frame.world().resource<CloseupSubjects>();
  std::vector<ExtraMap> maps;
  for (const CloseupView& pair : pairs) {
    maps.push_back({pair.face, subjects.subjects[pair.subject_index].casters});
    maps.back().face.index = pair.subject.index;  // distinguishes the maps of one light
  }
  return maps;
}

/// The passes of a frame's pairs, some pairs at a time.
class PairPasses {
 public:
  PairPasses(FrameBuilder& frame, const CloseupKnobs& knobs, const CloseupFrame& closeups)
      : frame_(frame),
        knobs_(knobs),
        map_size_(frame.world().view_resource<CloseupSettings>(frame.view().id).map_size),
        looked_(frame.get<ShadowsOutputs>()),
        suns_(directional_looks(frame.world().view_resource<VisibleLights>(frame.view().id))),
        overlay_(knobs.draws_standard),
        unculled_(frame) {
    if (knobs.single_fetches) looked_ = by_single_fetches(std::move(looked_));
    overlay_.start(frame, closeups.overlay);
  }

  /// Adds the pairs whose maps are kept over frames. Returns the others: those for whose maps there is no room.
  [[nodiscard]] std::vector<CloseupPlan> add_kept(std::span<const CloseupPlan> plans) {
    std::vector<CloseupView> pairs;
    bool copied = false;
    for (const CloseupPlan& plan : plans) {
      pairs.push_back(plan.pair);
      copied = copied || plan.in_overlay;
    }
    KeptMaps maps = drawer().draw_kept(frame_, "closeup", maps_of(frame_, pairs), map_size_, mips_for(copied));
    if (!frame_.status().ok()) return {};
    std::vector<CloseupPlan> kept, left;
    for (std::size_t i = 0; i < plans.size(); ++i) {
      (maps.squares[i].size > 0 ? kept : left).push_back(plans[i]);
      if (maps.squares[i].size > 0) kept.back().pair.face.square = maps.squares[i];
    }
    maps_drawn_ += maps.drawn;
    if (!kept.empty()) compose(kept, maps.atlas);
    return left;
  }
  /// Adds pairs batch by batch, with a map that all batches reuse.
  void add_batches(std::span<const CloseupPlan> plans) {
    if (plans.empty()) return;
    ExtraAtlas map = drawer().create(frame_, map_size_);
    for (std::span<const CloseupPlan> left = plans; !left.empty();) {
      const std::vector<CloseupPlan> batch = placed(left, knobs_.batch);
      left = left.subspan(batch.size());
      std::vector<CloseupView> pairs;
      for (const CloseupPlan& plan : batch) pairs.push_back(plan.pair);
      const bool copied = std::ranges::any_of(batch, &CloseupPlan::in_overlay);
      drawer().draw(frame_, "closeup", maps_of(frame_, pairs), map, mips_for(copied));
      maps_drawn_ += static_cast<std::uint32_t>(pairs.size());
      compose(batch, map);
    }
  }
  [[nodiscard]] std::uint32_t maps_drawn() const { return maps_drawn_; }
  void finish() {
    overlay_.finish(frame_);
    unculled_.finish(frame_);
  }

 private:
  [[nodiscard]] const ShadowMapDrawer& drawer() const { return frame_.get<ShadowMapDrawer>(); }
  /// copied: the overlay reads the maps, and with them their coarser mips.
  [[nodiscard]] MapMips mips_for(bool copied) const {
    return knobs_.single_fetches && !copied ? MapMips::bounds_only : MapMips::all;
  }
  void compose(std::span<const CloseupPlan> plans, ExtraAtlas& map) {
    ShadowsOutputs looked = looked_;
    looked.block = drawer().block(frame_, map.size);
    looked.atlas = map.atlas;
    looked.pyramid = map.pyramid;
    std::vector<CloseupView> pairs, copied;
    std::vector<shaders::CloseupConstants> constants;
    for (const CloseupPlan& plan : plans) {
      pairs.push_back(plan.pair);
      constants.push_back(constants_of(plan.pair, frame_.view(), suns_));
      if (plan.in_overlay) copied.push_back(plan.pair);
    }
    add_composition(frame_, pairs, constants, looked);
    for (std::size_t i = 0; i < pairs.size(); ++i) unculled_.add(frame_, pairs[i], looked, constants[i]);
    overlay_.add(frame_, copied, map);
  }

  FrameBuilder& frame_;
  CloseupKnobs knobs_;
  std::uint32_t map_size_;
  ShadowsOutputs looked_;  ///< with the filter for close-up maps
  std::vector<DirectionalLook> suns_;
  CloseupOverlay overlay_;
  UnculledPairs unculled_;
  std::uint32_t maps_drawn_ = 0;
};

}  // namespace

WithheldCasters withheld_casters(std::span<const CloseupView> pairs, const CloseupSubjects& subjects) {
  WithheldCasters withheld;
  for (const CloseupView& pair : pairs) {
    auto at = std::find_if(withheld.lights.begin(), withheld.lights.end(),
                           [&](const WithheldCasters::OfLight& of) { return of.light == pair.light; });
    if (at == withheld.lights.end()) at = withheld.lights.insert(at, {pair.light, {}});
    const std::vector<Entity>& casters = subjects.subjects[pair.subject_index].casters;
    at->casters.insert(at->casters.end(), casters.begin(), casters.end());
  }
  for (WithheldCasters::OfLight& of : withheld.lights) std::sort(of.casters.begin(), of.casters.end(), by_index);
  std::sort(withheld.lights.begin(), withheld.lights.end(),
            [](const auto& a, const auto& b) { return by_index(a.light, b.light); });
  return withheld;
}

bool closeup_pipelines_ready(const FrameBuilder& frame, const CloseupKnobs& knobs) {
  const auto* shadows = frame.find<ShadowsOutputs>();
  const auto* maps = frame.find<OverlayMaps>();
  if (shadows == nullptr || !shadows->final_lists || maps == nullptr) return false;
  const FrameServices& services = frame.services();
  const ShadowsOutputs looked = knobs.single_fetches ? by_single_fetches(*shadows) : *shadows;
  PipelineList list;
  list_composition_pipelines(looked, services.device.info(), list);
  list_bounds_pipelines(maps->d16(), list);
  list_closeup_overlay_pipelines(maps->d16(), list);
  return services.pipelines.request(list, services.log);
}

std::uint32_t add_closeup_passes(FrameBuilder& frame, const CloseupKnobs& knobs) {
  const auto* closeups = frame.find<CloseupFrame>();
  if (closeups == nullptr || closeups->pairs.empty()) return 0;
  if (frame.find<ShadowsOutputs>() == nullptr || frame.find<ShadowMapDrawer>() == nullptr) return 0;
  std::vector<CloseupPlan> plans = plans_of(*closeups, knobs.batch);
  PairPasses passes(frame, knobs, *closeups);
  // Drawing subjects into the overlay overwrites maps.
  const bool keeps =
      knobs.keeps_maps && !(knobs.draws_standard && std::ranges::any_of(plans, &CloseupPlan::in_overlay));
  if (keeps) plans = passes.add_kept(plans);
  if (!frame.status().ok()) return 0;
  passes.add_batches(plans);
  passes.finish();
  return passes.maps_drawn();
}

}  // namespace gloam
