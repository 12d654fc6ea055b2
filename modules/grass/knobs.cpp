// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/knobs.h"

#include "modules/shadows/outputs.h"

namespace gloam {

void add_grass_knobs(KnobRegistry& registry) {
  add_knobs(registry, "grass", kGrassSlaves, kGrassIterations, kGrassDensityScale, kGrassLodPixels, kGrassThreshold,
            kGrassCastDistance, kGrassCasters, kGrassShadowFilter, kGrassShadowTurns, kGrassAllSegments, kGrassReadback,
            kGrassFarSteps, kGrassThreads);
}

GrassKnobs grass_knobs(const KnobRegistry& registry) {
  GrassKnobs knobs;
  knobs.slaves_per_master = registry.value(kGrassSlaves);
  knobs.iterations = registry.value(kGrassIterations);
  knobs.density_scale = registry.value(kGrassDensityScale);
  knobs.lod_pixels = static_cast<float>(registry.value(kGrassLodPixels));
  knobs.threshold = registry.value(kGrassThreshold);
  knobs.cast_distance_m = static_cast<float>(registry.value(kGrassCastDistance));
  knobs.cast_every = registry.value(kGrassCasters);
  knobs.shadow_turns = registry.value(kGrassShadowTurns);
  knobs.threads = registry.value(kGrassThreads);
  knobs.readback = registry.value(kGrassReadback);
  knobs.far_steps = registry.value(kGrassFarSteps);
  knobs.all_segments = registry.value(kGrassAllSegments);
  return knobs;
}

}  // namespace gloam
