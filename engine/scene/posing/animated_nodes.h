// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/ecs/world.h"

namespace gloam {

/// The nodes that playing animations move: nodes with an animated pose, and their descendants.
class AnimatedNodes {
 public:
  /// With the channels that the world's animation system has bound in its last run. `world` must outlive it, and no
  /// Parent may change.
  explicit AnimatedNodes(const World& world);

  [[nodiscard]] bool moves(Entity node) const;
  /// Whether a playing channel animates the node's own pose.
  [[nodiscard]] bool has_channel(Entity node) const {
    return node.index < has_channel_.size() && has_channel_[node.index];
  }

 private:
  const World& world_;
  std::vector<bool> has_channel_;  ///< by Entity::index; empty if nothing is animated
};

}  // namespace gloam
