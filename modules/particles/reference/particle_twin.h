// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Particles in double precision: CPU twin of shaders/particles/simulation/motion_api.glsl.
#pragma once

#include <array>
#include <cstdint>

#include "engine/math/types.h"
#include "shaders/particles/particles_shared.h"

namespace gloam {

struct TwinParticle {
  dvec3 position = dvec3(0.0);  ///< camera-relative
  double radius_m = 0.0;
  double angle = 0.0;
  double opacity = 0.0;  ///< without the fade at the near plane
  double life = 0.0;
  double age_s = 0.0;
};

/// Four random words of a particle (Jarzynski and Olano 2020, pcg4d).
[[nodiscard]] std::array<std::uint32_t, 4> twin_lot(std::uint32_t seed, std::uint32_t number, std::uint32_t lot);

/// 24 bits of a word as 0…1, below 1.
[[nodiscard]] inline double unit_of(std::uint32_t word) { return static_cast<double>(word >> 8) / 16777216.0; }

/// The turbulence over its greatest speed.
[[nodiscard]] dvec3 twin_swirl(const dvec3& at, double time);

/// Particle k of the emitter. nudge: added to the position wherever the flow is looked up.
[[nodiscard]] TwinParticle twin_particle(const shaders::ParticleEmitterRow& e, std::uint32_t k,
                                         const dvec3& nudge = dvec3(0.0));

}  // namespace gloam
