// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <unordered_map>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/scene/posing/animation.h"

namespace gloam {

/// What places a node, as the transform system reads it.
using PlacingView =
    View<const WorldTransform, Maybe<const LocalTransform>, Maybe<const LocalMatrix>, Maybe<const Parent>>;

/// World matrices of nodes at any time, from the playing animations: those of the animation and transform systems.
class PoseSampler {
 public:
  /// All of them must outlive it.
  PoseSampler(const PlacingView& nodes, const AnimationBindings& bindings, const SceneAssets& assets);

  /// Whether an animation moves the node or an ancestor.
  [[nodiscard]] bool moves(Entity node) const;
  [[nodiscard]] dmat4 world_from_node(Entity node, double time_s) const;

 private:
  [[nodiscard]] Entity parent_of(Entity node) const;

  const PlacingView& nodes_;
  const SceneAssets& assets_;
  std::unordered_map<Entity, std::vector<AnimationBinding>> channels_;
};

}  // namespace gloam
