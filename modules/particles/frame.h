// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/render/frame_builder.h"
#include "modules/particles/knobs.h"
#include "shaders/particles/particles_shared.h"

namespace gloam {

/// Baked light of all emitters in one atlas of volumes; null images if no emitter has any.
struct BakedLightAtlas {
  ImageRef flux[3];  ///< red, green, blue
  ImageRef visibility;
};

/// One dispatch of the simulation.
struct SimulationDispatch {
  shaders::ParticleDispatch constants{};
  std::uint32_t groups = 0;
  bool one_emitter = false;  ///< all groups are of the emitter constants.row
  bool paths = false;        ///< emitters of the groups have paths
};

/// Points of a sprite at which light is summed before it is drawn.
[[nodiscard]] constexpr std::uint32_t lit_points(ParticleLighting lighting) {
  return lighting == ParticleLighting::sprite ? 1 : lighting == ParticleLighting::vertex ? 4 : 0;
}

/// Rows and constants that the passes of a view read.
struct ParticleInputs {
  ParticleLighting lighting = ParticleLighting::vertex;
  bool two_digits = false;      ///< the sort takes two passes
  std::uint32_t particles = 0;  ///< live ones of the emitters in view
  shaders::ParticleFrame constants{};
  gpu::Binding::BufferRange constants_range;  ///< `constants`
  gpu::Binding::BufferRange emitters;         ///< shaders::ParticleEmitterRow
  gpu::Binding::BufferRange poses;            ///< shaders::ParticlePose, of the emitters' paths; at least one
  gpu::Binding::BufferRange groups;           ///< uint: emitter row of each group of places
  std::vector<SimulationDispatch> dispatches;
  BakedLightAtlas atlas;
};

struct SimulatedParticles {
  BufferRef state;  ///< shaders::Particle, by place
  BufferRef keys;   ///< uint, by place
};

struct SortedParticles {
  BufferRef order;  ///< uint: places, far particles first; the first ParticleDraws::drawn are drawn
  BufferRef draws;  ///< shaders::ParticleDraws
};

/// The particles of one view of one frame, for visualizers and picking. On the board after PassPhase::translucent.
struct ParticlesFrame {
  ParticleInputs inputs;
  SimulatedParticles simulated;
  SortedParticles sorted;
  BufferRef light;  ///< uvec2 for each lit point of a drawn sprite; null if light is not summed before drawing
};

}  // namespace gloam
