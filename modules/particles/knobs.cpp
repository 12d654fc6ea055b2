// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/knobs.h"

namespace gloam {

void add_particle_knobs(KnobRegistry& registry) { add_knobs(registry, "particles", kParticleLighting, kParticleLight); }

ParticleLighting particle_lighting(const KnobRegistry& registry) {
  return registry.value(kParticleLight) ? registry.value(kParticleLighting) : ParticleLighting::off;
}

}  // namespace gloam
