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
};

/// The particles of one view of one frame, as its passes hand them on.
struct ParticlesFrame {
  ParticleLighting lighting = ParticleLighting::vertex;
  bool two_digits = false;      ///< the sort takes two passes
  std::uint32_t particles = 0;  ///< live ones of the emitters in view
  shaders::ParticleFrame constants{};
  gpu::Binding::BufferRange constants_range;
  gpu::Binding::BufferRange emitters;  ///< shaders::ParticleEmitterRow
  gpu::Binding::BufferRange groups;    ///< uint: emitter row of each group of places
  std::vector<SimulationDispatch> dispatches;
  BakedLightAtlas atlas;
  BufferRef state;  ///< shaders::Particle, by place
  BufferRef keys;   ///< uint, by place
  BufferRef order;  ///< uint: places, far particles first; the first ParticleDraws::drawn are drawn
  BufferRef draws;  ///< shaders::ParticleDraws
  BufferRef light;  ///< uvec2 for each lit point of a drawn sprite; null if light is not summed before drawing

  /// Points of a sprite at which light is summed before it is drawn.
  [[nodiscard]] std::uint32_t lit_points() const {
    return lighting == ParticleLighting::sprite ? 1 : lighting == ParticleLighting::vertex ? 4 : 0;
  }
};

}  // namespace gloam
