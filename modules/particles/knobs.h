// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/knobs/knobs.h"

namespace gloam {

/// Points of a sprite at which light is summed: its middle, its four corners, or each pixel. off: none.
enum class ParticleLighting : std::uint8_t { sprite, vertex, pixel, off };

void add_particle_knobs(KnobRegistry& registry);
/// Of particles.lighting and particles.light.
[[nodiscard]] ParticleLighting particle_lighting(const KnobRegistry& registry);

}  // namespace gloam
