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
#include "engine/render/draws/draw_lists.h"
#include "modules/shadows/outputs.h"

namespace gloam {

/// Where a caster was in a frame; low above high where that is not known.
struct CasterBox {
  dvec3 low = dvec3(0.0);
  dvec3 high = dvec3(0.0);
  [[nodiscard]] bool known() const { return low.x <= high.x && low.y <= high.y && low.z <= high.z; }
};

/// What a caster is in one frame.
struct CasterState {
  std::uint64_t hash = 0;  ///< of where it is, how it is posed and what it is made of: equal ones draw the same
  bool unsteady = false;   ///< its vertices move and nobody knows how: two frames' are never the same
  CasterBox box;
  Entity entity;
};

/// Whether a caster is among those that WithheldCasters::of gives.
[[nodiscard]] bool is_withheld(std::span<const Entity> withheld, Entity caster);

/// Numbers for how casters are posed, by index; of one whose vertices the GPU does not move, or whose pose is not
/// known, 0.
[[nodiscard]] std::vector<std::uint64_t> caster_poses(const World& world, const DrawLists& draws);

/// One a caster. `poses`: as caster_poses gives them, or none.
[[nodiscard]] std::vector<CasterState> caster_states(std::span<const Caster> casters,
                                                     std::span<const std::uint64_t> poses, JobExecutor& executor);

/// How casters differ from frame to frame. Frames are numbered from 1.
class CasterHistory {
 public:
  /// What maps leave out in the frame that advance() begins next, and in those that follow.
  void withhold(WithheldCasters withheld) { next_withheld_ = std::move(withheld); }
  /// The newest frame's casters, ordered by Entity::index; every call is a frame.
  void advance(std::vector<CasterState> states);
  /// Number of the newest frame.
  [[nodiscard]] std::uint64_t frame() const { return frame_; }
  /// Of the newest frame.
  [[nodiscard]] std::span<const CasterState> states() const { return states_; }
  /// Likewise.
  [[nodiscard]] const WithheldCasters& withheld() const { return withheld_; }
  [[nodiscard]] std::span<const Entity> withheld(Entity light) const { return withheld_.of(light); }
  /// Where something is in the newest frame that was not there, or not so, in the one before; and the other way round.
  [[nodiscard]] std::span<const CasterBox> changed() const { return changed_; }
  /// The same as maps of the light have it: what they leave out is not there.
  [[nodiscard]] std::span<const CasterBox> changed(Entity light) const;
  /// Whether a caster of the newest frame has been as it is for kRestFrames frames, or since the first.
  [[nodiscard]] bool rests(std::size_t caster) const {
    return since_[caster] <= 1 || since_[caster] + kRestFrames <= frame_;
  }
  static constexpr std::uint64_t kRestFrames = 16;

 private:
  /// changed() of a light whose maps leave something out, in the newest frame or the one before.
  struct Changed {
    Entity light;
    std::vector<CasterBox> boxes;
  };
  [[nodiscard]] std::vector<CasterBox> find_changed(Entity light, std::span<const CasterState> before) const;

  std::uint64_t frame_ = 0;
  std::vector<std::uint64_t> since_;  ///< the frame that each has been the same since
  std::vector<CasterState> states_;
  std::vector<CasterBox> changed_;
  std::vector<Entity> changed_casters_;  ///< of changed_
  std::size_t gone_ = 0;                 ///< how many of changed_ are of the frame before the newest; they come first
  WithheldCasters next_withheld_;
  WithheldCasters withheld_;         ///< in the newest frame
  WithheldCasters withheld_before_;  ///< in the one before
  std::vector<Changed> changed_of_;  ///< by light
};

}  // namespace gloam
