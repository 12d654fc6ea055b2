// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/declare/compute_pass.h"
#include "modules/lighting/outputs.h"
#include "modules/particles/frame.h"

namespace gloam {

/// The version of shaders that include scattered_light.glsl which a frame calls for. Particles see no shadow maps.
struct ParticleLightVersion {
  bool cookies = false;
  gpu::SpecConstants constants = {{"kMaps", 0u}};
};
[[nodiscard]] ParticleLightVersion particle_light_version(const FrameBuilder& frame, const BakedLightAtlas& atlas);

/// lit_points: of a sprite, 1 or 4.
[[nodiscard]] ComputeProgram particle_light_program(const ParticleLightVersion& version, std::uint32_t lit_points);

/// Binds the inputs of scattered_light.glsl that the program in use declares.
void read_particle_light(ShaderPass& pass, FrameBuilder& frame, const BakedLightAtlas& atlas);

/// Sums the light at the lit points of the drawn sprites: uvec2 for each. lit_points(inputs.lighting) > 0.
[[nodiscard]] BufferRef add_particle_light_pass(FrameBuilder& frame, const ParticleInputs& inputs,
                                                const SimulatedParticles& simulated, const SortedParticles& sorted);

}  // namespace gloam
