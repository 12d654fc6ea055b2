// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/knobs.h"

#include <utility>

namespace gloam {

void add_particle_knobs(KnobRegistry& registry) {
  Knob lighting;
  lighting.name = "particles.lighting";
  lighting.module = "particles";
  lighting.meaning =
      "points at which light on a particle is summed: the middle of its sprite, the sprite's four corners (vertex), or "
      "every pixel";
  lighting.choices = {"sprite", "vertex", "pixel"};
  lighting.default_number = 1;
  lighting.exact = "pixel";
  registry.add(std::move(lighting));
  Knob light;
  light.name = "particles.light";
  light.module = "particles";
  light.meaning = "whether lights and surroundings light particles (on), or all have the mean light of the sky (off)";
  light.choices = {"on", "off"};
  light.exact = "on";
  registry.add(std::move(light));
}

ParticleLighting particle_lighting(const KnobRegistry& registry) {
  if (registry.is("particles.light", "off")) return ParticleLighting::off;
  return static_cast<ParticleLighting>(registry.choice("particles.lighting"));
}

}  // namespace gloam
