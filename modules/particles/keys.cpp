// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/keys.h"

#include <string>
#include <utility>

#include "engine/ecs/view.h"
#include "engine/scene/keys/table.h"
#include "engine/scene/units.h"
#include "modules/particles/components.h"

namespace gloam {

void add_particle_keys(KeyRegistry& registry) {
  const auto line = [](std::string key, std::string fallback, std::string unit, std::string meaning) {
    return key_line("particles", KeyElement::node, std::move(key), std::move(fallback), std::move(unit),
                    std::move(meaning));
  };
  registry.add(choice_key(line("gloam.particles", "", "", "kind of a particle emitter"),
                          {"fog", "dust", "smoke", "fire"}, EmitterKind::fog, &ParticleEmitter::kind));
  registry.add(number_key(line("gloam.particles.rate", "20", "1/s", "particles emitted per second"), 0, 1e6,
                          &ParticleEmitter::rate));
  registry.add(number_key(line("gloam.particles.lifetime", "2", "s", "lifetime of a particle"), 1e-3, 1e4,
                          &ParticleEmitter::lifetime_s));
  registry.add(
      number_key(line("gloam.particles.size", "0.3", "m", "size of a particle"), 1e-6, 1e3, &ParticleEmitter::size_m));
  registry.add(number_key(line("gloam.particles.speed", "0.5", "m/s", "speed of a particle when it is emitted"), 0, 1e3,
                          &ParticleEmitter::speed));
  registry.add(
      number_key(line("gloam.particles.spread", "20", "degrees", "half angle of the cone of directions around +Y"), 0,
                 180, &ParticleEmitter::spread, kPi / 180.0));
  registry.add(vec3_key(line("gloam.particles.box", "[1, 1, 1]", "m", "size of the box in which particles are emitted"),
                        0, 1e6, &ParticleEmitter::box_m));
  registry.add_finish("particles", [](World& world) {
    const auto unit_m = static_cast<float>(metres_per_unit(world));
    world.view<ParticleEmitter>().each([&](ParticleEmitter& emitter) {
      emitter.speed /= unit_m;
      emitter.metres_per_unit = unit_m;
    });
    return Status();
  });
}

}  // namespace gloam
