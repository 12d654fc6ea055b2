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

/// Time within a clip that loops for ever: time_s modulo duration_s, in [0, duration_s) also for negative times.
/// Returns 0 if duration_s is not positive.
[[nodiscard]] double looped_time(double time_s, double duration_s);

/// Spherical interpolation between unit quaternions on the shorter arc, u in [0, 1]. The result has unit length.
/// Accurate for equal, nearly equal and opposite inputs. If the rotations are half a turn apart, both arcs are equally
/// long and the result follows the one that starts towards `b`.
[[nodiscard]] dquat slerp_shortest(const dquat& a, const dquat& b, double u);

/// Samples a channel as glTF 2.0 (§ 3.11, appendix C) defines it. Before the first key and after the last one, that
/// key's value holds. out: exactly channel.width values; a rotation is x, y, z, w with unit length (identity where a
/// key is zero). channel.times and .values must have the sizes that AnimationChannel states (asserted).
void sample_channel(const AnimationChannel& channel, double time_s, std::span<double> out);

/// Entity of each glTF node index; kNoEntity for nodes that are not in the world. Filled by the animation system.
struct SceneNodes {
  std::vector<Entity> entities;
  std::uint64_t version = 0;  ///< incremented when `entities` changes
  Tick seen = 0;              ///< `entities` holds the SourceNode changes up to this tick

  [[nodiscard]] Entity find(std::uint32_t node) const { return node < entities.size() ? entities[node] : kNoEntity; }
};

/// A playing channel and the entity that it animates.
struct AnimationBinding {
  Entity entity;
  std::uint32_t clip = 0;
  std::uint32_t channel = 0;
};

/// The playing channels: all channels whose node is in the world. If several channels have the same node and path, the
/// first in clip order plays.
struct AnimationBindings {
  std::vector<AnimationBinding> poses;    ///< translation, rotation, scale
  std::vector<AnimationBinding> weights;  ///< morph weights
  std::uint64_t nodes_version = 0;        ///< SceneNodes::version at the last binding
  std::uint64_t assets_version = 0;       ///< SceneAssets::version at the last binding
};

/// Replaces bindings.poses and .weights, ordered by clip, then by channel. Leaves the versions to the caller.
void bind_animations(std::span<const AnimationClip> clips, const SceneNodes& nodes, AnimationBindings& bindings);

}  // namespace gloam
