// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/posing/animated_nodes.h"

#include <algorithm>

#include "engine/scene/components.h"
#include "engine/scene/posing/animation.h"

namespace gloam {

AnimatedNodes::AnimatedNodes(const World& world) : world_(world) {
  const AnimationBindings* bindings = world.try_resource<AnimationBindings>();
  if (bindings == nullptr) return;
  for (const AnimationBinding& binding : bindings->poses) {
    if (!world.alive(binding.entity)) continue;
    has_channel_.resize(std::max(has_channel_.size(), std::size_t{binding.entity.index} + 1));
    has_channel_[binding.entity.index] = true;
  }
}

bool AnimatedNodes::moves(Entity node) const {
  if (has_channel_.empty()) return false;
  while (!has_channel(node)) {
    const Parent* parent = world_.try_get<Parent>(node);
    if (parent == nullptr || !world_.alive(parent->entity)) return false;
    node = parent->entity;
  }
  return true;
}

}  // namespace gloam
