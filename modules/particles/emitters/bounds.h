// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/types.h"
#include "engine/render/packing/caster_bounds.h"
#include "modules/particles/components.h"
#include "modules/particles/emitters/placed.h"

namespace gloam {

/// Greatest diameter of a sprite of the emitter at any age, metres.
[[nodiscard]] float largest_sprite_m(const ParticleEmitter& emitter);

/// World box around all sprites of the emitter at all times. Uses all other members of PlacedEmitter but `rate`.
[[nodiscard]] WorldBox emitter_bounds(const PlacedEmitter& emitter);

}  // namespace gloam
