// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/math/types.h"
#include "modules/lights/components.h"

namespace gloam {

/// Hashes of the lights of a world, to find out whether lights are still as they were baked.
class LightStates {
 public:
  void add(Entity entity, const Light& light, const dmat4& world_from_node);
  /// Of these lights together, in this order. Lights that are gone or that were not added count as such.
  [[nodiscard]] std::uint64_t of(std::span<const Entity> lights) const;

 private:
  struct State {
    Entity entity = kNoEntity;
    std::uint64_t hash = 0;
  };
  std::vector<State> states_;  ///< by Entity::index
};

}  // namespace gloam
