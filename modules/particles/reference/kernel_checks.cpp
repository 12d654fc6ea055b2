// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/reference/kernel_checks.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/text/formatted.h"
#include "modules/particles/reference/particle_twin.h"
#include "modules/particles/reference/simulation_run.h"

namespace gloam {
namespace {

constexpr EmitterKind kKinds[] = {EmitterKind::fog, EmitterKind::dust, EmitterKind::smoke, EmitterKind::fire};

SimulationRows emitters_of_all_kinds() {
  std::mt19937 random(4);
  SimulationRows rows;
  for (std::uint32_t i = 0; i < 24; ++i) {
    PlacedEmitter placed;
    if (place_emitter(Entity{i, 1}, any_emitter(random, kKinds[i % 4]), any_pose(random), placed))
      rows.add(placed, 1000 * std::int64_t{i});
  }
  return rows;
}

/// How far a particle is from its twin. Turbulence enlarges a shift by a factor that differs between particles, so the
/// distance is divided by it.
double particle_error(const shaders::Particle& p, const shaders::ParticleEmitterRow& row, std::uint32_t k) {
  constexpr double kNudge = 1e-5;
  const TwinParticle twin = twin_particle(row, k);
  const double nudged = glm::length(twin_particle(row, k, dvec3(kNudge)).position - twin.position);
  const double shifted = glm::length(dvec3(p.position) - twin.position) / (1.0 + nudged / kNudge);
  const double radius = std::abs(static_cast<double>(p.radius_m) - twin.radius_m);
  const double more_opaque = static_cast<double>(p.opacity) - twin.opacity;  // near the camera it may be less
  const double worst = std::max({shifted, radius, std::abs(static_cast<double>(p.life) - twin.life), more_opaque});
  return std::isfinite(shifted + radius + more_opaque) ? worst : shifted + radius + more_opaque;
}

Result<KernelError> run_all_kinds(KernelLab& lab) {
  const SimulationRows rows = emitters_of_all_kinds();
  const auto found = run_particles(lab, rows);
  if (!found) return found.error();
  KernelError error;
  for (std::size_t i = 0; i < rows.rows.size(); ++i) {
    const shaders::ParticleEmitterRow& row = rows.rows[i];
    for (std::uint32_t k = 0; k < row.count; ++k)
      error.add(particle_error(found->particles[row.first + k], row, k), formatted("emitter %zu, particle %u", i, k));
  }
  return error;
}

}  // namespace

std::vector<KernelCheck> particle_kernel_checks() {
  return {{.name = "kernel.particles",
           .sentence = "places, radii and opacities of particles against those in double precision",
           .unit = "m",
           // Places are up to 30 m from the camera, where floats lie 1.9e-6 m apart. A particle's way is the sum of
           // about ten such numbers, and the phases of its turbulence are rounded, too.
           .bound = 4e-5,
           .advice = "Leave emitters of particles out, and report the device",
           .quick = true,
           .run = &run_all_kinds}};
}

}  // namespace gloam
