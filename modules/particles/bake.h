// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/render/reference/scene_tracer.h"
#include "modules/particles/baked_light.h"

namespace gloam {

/// Input of bake_particle_light(). `world`: as the world stage's systems left it, or just loaded. tracer: the triangles
/// that do not move.
struct ParticleBakeInput {
  const World& world;
  const SceneTracer& tracer;
  JobExecutor& executor;
  /// Reports texels that are done; called by one thread at a time; may be empty.
  std::function<void(std::size_t done, std::size_t total)> progress = {};
};

/// The maps of all emitters that do not move. Lights that do not move and have no cookie are static: their light, with
/// traced shadows, and that of the sky and the ground is in the flux. Of the lights that do not move and have a cookie,
/// the strongest kBakedLights at an emitter have their visibility in its map. Version 0. The result depends on world
/// and triangles only, not on the executor.
[[nodiscard]] ParticleLightMaps bake_particle_light(const ParticleBakeInput& input);

/// Hash of everything that bake_particle_light() depends on: emitters, lights, sky and triangles. Maps with another
/// hash are out of date.
[[nodiscard]] std::uint64_t particle_light_content(const World& world, const SceneTracer& tracer);

/// Sets static_state and dynamic_state of the maps: their light is that of the world's lights as they are now.
void mark_as_current(const World& world, ParticleLightMaps& maps);

/// The maps as bytes, for a cache; entities are named by their order in the world.
[[nodiscard]] std::string encode_particle_light(const World& world, const ParticleLightMaps& maps);
/// None if the bytes are not of encode_particle_light() or name an entity that the world does not have. The maps are
/// marked as current: call it only if particle_light_content() is that of the baked world.
[[nodiscard]] std::optional<ParticleLightMaps> decode_particle_light(const World& world, std::string_view bytes);

}  // namespace gloam
