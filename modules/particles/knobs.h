// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/knobs/knob_table.h"

namespace gloam {

/// Points of a sprite at which light is summed: its middle, its four corners, or each pixel. off: none.
enum class ParticleLighting : std::uint8_t { sprite, vertex, pixel, off };

/// Without ParticleLighting::off, which kParticleLight gives.
inline constexpr ChoiceKnob<ParticleLighting> kParticleLighting{
    .name = "particles.lighting",
    .meaning =
        "points at which light on a particle is summed: the middle of its sprite, the sprite's four corners "
        "(vertex), or every pixel",
    .choices = {{"sprite", ParticleLighting::sprite},
                {"vertex", ParticleLighting::vertex},
                {"pixel", ParticleLighting::pixel}},
    .default_value = ParticleLighting::vertex,
    .exact = ParticleLighting::pixel,
    .only_with = "particles.light=on"};
inline constexpr OnOffKnob kParticleLight{
    .name = "particles.light",
    .meaning = "whether lights and surroundings light particles (on), or all have the mean light of the sky (off)",
    .choices = {{"on", true}, {"off", false}},
    .default_value = true,
    .exact = true};

void add_particle_knobs(KnobRegistry& registry);
/// Of particles.lighting and particles.light.
[[nodiscard]] ParticleLighting particle_lighting(const KnobRegistry& registry);

}  // namespace gloam
