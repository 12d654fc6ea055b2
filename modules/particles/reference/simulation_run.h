// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/kernel_check/kernel_lab.h"
#include "engine/render/view.h"
#include "modules/particles/components.h"
#include "modules/particles/emitters/placed.h"
#include "shaders/particles/particles_shared.h"

namespace gloam {

/// What simulate.comp writes, by place.
struct ParticleStates {
  std::vector<shaders::Particle> particles;
  std::vector<std::uint32_t> keys;
};

/// The rows of emitters in a view, one after the other.
struct SimulationRows {
  RenderView view;
  std::vector<shaders::ParticleEmitterRow> rows;
  std::vector<shaders::ParticlePose> poses;
  std::vector<std::uint32_t> groups;

  /// A view of 320×180 pixels from 6 m.
  SimulationRows();
  /// Adds the emitter at a step of its clock.
  void add(const PlacedEmitter& emitter, std::int64_t step);
  [[nodiscard]] shaders::ParticleFrame frame() const;
  [[nodiscard]] std::size_t places() const { return groups.size() * GLOAM_PARTICLE_GROUP; }
};

/// Runs the kernel once for all emitters.
[[nodiscard]] Result<ParticleStates> run_particles(const KernelLab& lab, const SimulationRows& rows);

/// The row of an emitter that a view at `eye` sees, at a step.
[[nodiscard]] shaders::ParticleEmitterRow row_at(const PlacedEmitter& emitter, std::int64_t step,
                                                 const dvec3& eye = dvec3(0.0), std::uint32_t first = 0);
/// A pose with any rotation, scale and shear, near the origin.
[[nodiscard]] dmat4 any_pose(std::mt19937& random);
/// An emitter with values from the middle of the ranges of the scene keys.
[[nodiscard]] ParticleEmitter any_emitter(std::mt19937& random, EmitterKind kind);

}  // namespace gloam
