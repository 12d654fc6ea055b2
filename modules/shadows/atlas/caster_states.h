// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/math/types.h"
#include "engine/render/draws/caster_source.h"
#include "engine/render/draws/draw_lists.h"
#include "modules/shadows/outputs.h"

namespace gloam {

/// World-space bounds of a caster in a frame; unknown when low is above high on any axis.
struct CasterBox {
  dvec3 low = dvec3(0.0);
  dvec3 high = dvec3(0.0);
  double emissive_reach_m = 0.0;  ///< Caster::emissive_reach_m
  std::uint32_t turns = 1;        ///< CasterSource::turns
  std::uint64_t content = 0;      ///< CasterSource::content_hash, if it takes turns
  [[nodiscard]] bool known() const { return low.x <= high.x && low.y <= high.y && low.z <= high.z; }
};

/// State of one caster in one frame.
struct CasterState {
  std::uint64_t hash = 0;  ///< of position, pose, mesh and material: casters with equal hashes draw the same
  bool unsteady = false;   ///< its vertices move in an unknown way: it differs from frame to frame
  CasterBox box;
  Entity entity;
};

/// Whether the caster is in the list, which is ordered by Entity::index: a result of WithheldCasters::of(), or
/// ExtraMap::casters.
[[nodiscard]] bool holds_caster(std::span<const Entity> list, Entity caster);

/// A hash of each caster's pose, in the order of draws.casters. 0: the GPU does not move its vertices, or its pose is
/// unknown.
[[nodiscard]] std::vector<std::uint64_t> caster_poses(const World& world, const FrameDraws& draws);

/// The state of each caster, in order. poses: result of caster_poses(), or empty.
[[nodiscard]] std::vector<CasterState> caster_states(std::span<const Caster> casters,
                                                     std::span<const std::uint64_t> poses, JobExecutor& executor);

/// The state of each source, in order.
[[nodiscard]] std::vector<CasterState> source_states(std::span<const CasterSource* const> sources);

/// Tracks how casters change from frame to frame. Frames are numbered from 1.
class CasterHistory {
 public:
  /// Sets the casters that maps leave out, from the next frame on.
  void withhold(WithheldCasters withheld) { next_withheld_ = std::move(withheld); }
  /// The history with one more frame, which has these casters. The last `sources` states are those of caster sources,
  /// in any order; the states before them are ordered by Entity::index.
  [[nodiscard]] CasterHistory advanced(std::vector<CasterState> states, std::size_t sources = 0) const;
  /// Number of the newest frame.
  [[nodiscard]] std::uint64_t frame() const { return frame_; }
  /// The casters of the newest frame.
  [[nodiscard]] std::span<const CasterState> states() const { return states_; }
  /// The withheld casters of the newest frame.
  [[nodiscard]] const WithheldCasters& withheld() const { return withheld_; }
  /// Those of the next frame, by withhold().
  [[nodiscard]] const WithheldCasters& next_withheld() const { return next_withheld_; }
  [[nodiscard]] std::span<const Entity> withheld(Entity light) const { return withheld_.of(light); }
  /// Boxes of all casters that changed between the frame before and the newest one: first all old boxes, then all new
  /// ones.
  [[nodiscard]] std::span<const CasterBox> changed() const { return changed_; }
  /// The same for the maps of one light, which leave its withheld casters out. A caster that becomes withheld, or stops
  /// being withheld, counts as changed.
  [[nodiscard]] std::span<const CasterBox> changed(Entity light) const;
  /// A hash of the newest states of the casters and sources withheld from this light. No other frame has the same, if
  /// one of them is unsteady.
  [[nodiscard]] std::uint64_t withheld_hash(Entity light) const;
  /// Whether a caster (index into states()) has not changed for kRestFrames frames, or since frame 1: a resting caster.
  [[nodiscard]] bool rests(std::size_t caster) const {
    return since_[caster] <= 1 || since_[caster] + kRestFrames <= frame_;
  }
  static constexpr std::uint64_t kRestFrames = 16;

 private:
  /// changed() of a light with withheld casters in the newest frame or the one before.
  struct Changed {
    Entity light;
    std::vector<CasterBox> boxes;
  };
  [[nodiscard]] std::vector<CasterBox> find_changed(Entity light, const CasterHistory& before) const;

  std::uint64_t frame_ = 0;
  std::vector<std::uint64_t> since_;  ///< by caster: the frame since which it has not changed
  std::vector<CasterState> states_;
  std::size_t sources_ = 0;  ///< number of states at the end that are those of sources
  std::vector<CasterBox> changed_;
  std::vector<Entity> changed_casters_;  ///< by index into changed_
  std::size_t gone_ = 0;                 ///< the first gone_ boxes of changed_ are old boxes, of the frame before
  WithheldCasters next_withheld_;
  WithheldCasters withheld_;         ///< of the newest frame
  std::vector<Changed> changed_of_;  ///< ascending by light
};

}  // namespace gloam
