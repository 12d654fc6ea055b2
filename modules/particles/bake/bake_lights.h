// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/world.h"
#include "modules/particles/emitters/placed.h"
#include "modules/shadows/reference.h"

namespace gloam {

/// The lights that a bake knows.
struct BakeLights {
  TwinLights all;                           ///< that shine, by entity index
  std::vector<std::uint32_t> with_flux;     ///< positions in `all`: at rest, without a cookie
  std::vector<std::uint32_t> with_cookies;  ///< positions in `all`: at rest, with a cookie
};
[[nodiscard]] BakeLights gather_bake_lights(const World& world, const SceneTracer& tracer);

/// Emitters at rest that emit, by entity index.
[[nodiscard]] std::vector<PlacedEmitter> emitters_at_rest(const World& world);

/// Positions in `all` of the strongest kBakedLights of with_cookies at the emitter, the strongest first; those that do
/// not reach it are left out.
[[nodiscard]] std::vector<std::uint32_t> strongest_with_cookies(const World& world, const BakeLights& lights,
                                                                const PlacedEmitter& emitter,
                                                                const dvec3& tracer_origin);

}  // namespace gloam
