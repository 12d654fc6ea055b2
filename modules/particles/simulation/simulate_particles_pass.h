// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/render/declare/compute_pass.h"
#include "modules/particles/frame.h"

namespace gloam {

/// one_emitter, paths: as in SimulationDispatch.
[[nodiscard]] ComputeProgram particle_simulation_program(bool one_emitter, bool paths);

/// Emitters of as many groups have a dispatch each, up to kMostOwnDispatches.
inline constexpr std::uint32_t kLeastOwnGroups = 8, kMostOwnDispatches = 64;
/// The dispatches that cover all groups, each once. emitter_of_group: ascending.
[[nodiscard]] std::vector<SimulationDispatch> simulation_dispatches(std::span<const std::uint32_t> emitter_of_group);

/// Computes the state and the sort key of each particle of the view's emitters.
[[nodiscard]] SimulatedParticles add_particle_simulation_pass(FrameBuilder& frame, const ParticleInputs& inputs);

}  // namespace gloam
