// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "modules/lighting/components.h"
#include "modules/particles/components.h"

namespace gloam {

/// The flame that an emitter shows; none if it is no fire or its values are not usable.
[[nodiscard]] std::optional<Flame> flame_of(Entity entity, const ParticleEmitter& emitter);

/// Mean light of the emitter's sprites over a long time (FlameSource::picture), without turbulence.
[[nodiscard]] std::vector<vec4> flame_picture(const ParticleEmitter& emitter, std::uint32_t side);

/// The fires among the emitters of a world.
[[nodiscard]] FlameSource particle_flames();

}  // namespace gloam
