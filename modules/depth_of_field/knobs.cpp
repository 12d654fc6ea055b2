// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/knobs.h"

namespace gloam {

void add_dof_knobs(KnobRegistry& registry) {
  add_knobs(registry, "depth_of_field", kDofCache, kDofRadius, kDofFullResolution);
}

DofKnobs dof_knobs(const KnobRegistry& registry) {
  DofKnobs knobs;
  knobs.cache = registry.value(kDofCache);
  knobs.radius = static_cast<float>(registry.value(kDofRadius));
  knobs.full_resolution = registry.value(kDofFullResolution);
  return knobs;
}

}  // namespace gloam
