// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/ecs/component.h"
#include "engine/ecs/entity.h"
#include "engine/math/types.h"
#include "engine/scene/assets.h"

namespace gloam {

/// Time within a clip that plays for ever: in [0, duration_s), for negative times too. 0 when the duration is not
/// positive.
[[nodiscard]] double looped_time(double time_s, double duration_s);

/// Interpolates between unit quaternions on the shorter arc, u in [0, 1]; unit length. Accurate for equal, nearly equal
/// and opposite inputs; of the two equal arcs between rotations half a turn apart it takes the one that starts towards
/// `b`.
[[nodiscard]] dquat slerp_shortest(const dquat& a, const dquat& b, double u);

/// Value of a channel at a time, as glTF 2.0 (§ 3.11, appendix C) states it. Before the first key and after the last
/// one the end values hold. out: exactly channel.width values; rotations are x, y, z, w and unit length (identity where
/// a key is zero). channel.times and .values as AnimationChannel says (sizes are asserted).
void sample_channel(const AnimationChannel& channel, double time_s, std::span<double> out);

/// Entity of each glTF node index; kNoEntity for nodes that are not in the world. Made by the animation system.
struct SceneNodes {
  std::vector<Entity> entities;
  std::uint64_t version = 0;  ///< grows when `entities` changes
  Tick seen = 0;              ///< changes of SourceNode up to this tick are in

  [[nodiscard]] Entity find(std::uint32_t node) const { return node < entities.size() ? entities[node] : kNoEntity; }
};

/// A channel that plays, and what it moves.
struct AnimationBinding {
  Entity entity;
  std::uint32_t clip = 0;
  std::uint32_t channel = 0;
};

/// Which channels play: all whose node is in the world; of channels with the same node and path the first in clip
/// order.
struct AnimationBindings {
  std::vector<AnimationBinding> poses;    ///< translation, rotation, scale
  std::vector<AnimationBinding> weights;  ///< morph weights
  std::uint64_t nodes_version = 0;        ///< SceneNodes::version they were made for
  std::uint64_t assets_version = 0;       ///< SceneAssets::version they were made for
};

/// Fills bindings.poses and .weights, in clip and channel order.
void bind_animations(std::span<const AnimationClip> clips, const SceneNodes& nodes, AnimationBindings& bindings);

}  // namespace gloam
