// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/world.h"
#include "modules/particles/bake.h"
#include "modules/particles/emitters/placed.h"
#include "modules/shadows/reference.h"

namespace gloam {

/// The lights that a bake knows.
struct BakeLights {
  TwinLights all;                           ///< that shine, by entity index
  std::vector<std::uint32_t> with_flux;     ///< positions in `all`: of the moment, without a cookie
  std::vector<std::uint32_t> with_cookies;  ///< positions in `all`: of the moment, with a cookie
};
[[nodiscard]] BakeLights gather_bake_lights(const World& world, const SceneTracer& tracer, BakedMoment moment);

/// Emitters of the options that emit, by entity index.
[[nodiscard]] std::vector<PlacedEmitter> gather_bake_emitters(const World& world, const ParticleBakeOptions& options);

/// The lights of one emitter's map, as positions in BakeLights::all.
struct LightsOfMap {
  std::vector<std::uint32_t> flux;        ///< ascending
  std::vector<std::uint32_t> visibility;  ///< at most kBakedLights, of which each reaches the emitter
};
[[nodiscard]] LightsOfMap divide_lights(const World& world, const BakeLights& lights, const PlacedEmitter& emitter,
                                        const dvec3& tracer_origin, BakedMoment moment);

}  // namespace gloam
