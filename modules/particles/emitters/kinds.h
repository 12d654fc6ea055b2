// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/types.h"
#include "modules/particles/components.h"

namespace gloam {

/// How the particles of one kind move and look. Shares of the lifetime are in 0…1.
struct KindProperties {
  float rise = 0.0f;           ///< speed along the world's +Y that drag and buoyancy lead to, m/s
  float drag = 1.0f;           ///< 1/s, > 0: the rate at which a particle takes on that speed
  float turbulence = 0.0f;     ///< greatest speed of the swirls along each axis, m/s
  float swirl_m = 1.0f;        ///< size of the swirls, > 0
  float growth = 1.0f;         ///< size at death ÷ size at birth, > 0
  float spin = 0.0f;           ///< greatest speed of rotation, radians/s
  float opacity = 0.1f;        ///< greatest opacity of a sprite, 0…1
  float fade_in = 0.1f;        ///< share of the lifetime during which a particle appears, > 0
  float fade_out = 0.5f;       ///< share of the lifetime during which it disappears, > 0
  float erosion = 0.5f;        ///< how far noise eats into the disc, 0…1
  float forward = 0.0f;        ///< how much brighter the side towards a light is: 1 + forward · cos, 0…1
  float cover = 1.0f;          ///< share of its opacity with which a sprite hides what is behind it; the rest adds
  vec3 albedo = vec3(0.8f);    ///< share of the light that is scattered
  vec3 emission = vec3(0.0f);  ///< cd/m² of an opaque sprite at birth
  vec3 cooled = vec3(1.0f);    ///< factor of the emission at death
};

/// kind: not none.
[[nodiscard]] const KindProperties& kind_properties(EmitterKind kind);
/// Those of the emitter's kind, with lengths in units of the world.
[[nodiscard]] KindProperties kind_of(const ParticleEmitter& emitter);

}  // namespace gloam
