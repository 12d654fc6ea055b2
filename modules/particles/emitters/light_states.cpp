// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/light_states.h"

#include <algorithm>

#include "engine/core/hash.h"

namespace gloam {

void LightStates::add(Entity entity, const Light& light, const dmat4& world_from_node) {
  Hasher hasher;
  hasher.value(light.kind).value(light.cookie);
  hasher.bytes_of(light.color).bytes_of(world_from_node);
  for (const float value :
       {light.intensity, light.range_m, light.inner_angle, light.outer_angle, light.width_m, light.apparent_angle})
    hasher.bytes_of(value);
  states_.resize(std::max(states_.size(), std::size_t{entity.index} + 1));
  states_[entity.index] = {entity, hasher.digest()};
}

std::uint64_t LightStates::of(std::span<const Entity> lights) const {
  Hasher hasher;
  for (const Entity light : lights) {
    const bool known = light.index < states_.size() && states_[light.index].entity == light;
    hasher.value(known).value(known ? states_[light.index].hash : 0);
  }
  return hasher.digest();
}

}  // namespace gloam
