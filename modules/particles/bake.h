// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/render/reference/scene_tracer.h"
#include "modules/particles/baked_light.h"

namespace gloam {

/// The emitters and lights that bake_particle_light() bakes.
enum class BakedMoment : std::uint8_t {
  at_rest,  ///< emitters and lights that do not move; lights with a cookie stay dynamic
  now,  ///< all of them as they are now; the strongest kBakedLights of an emitter stay dynamic, lights with a cookie
        ///< first, so that each lit point has their exact light
};

/// Options of bake_particle_light(): the moment, the emitters, and the numbers of texels and rays.
struct ParticleBakeOptions {
  BakedMoment moment = BakedMoment::at_rest;
  /// The emitters that get a map, ascending by Entity::index; empty: all of the moment.
  std::vector<Entity> emitters = {};
  double texel_m = 0.25;         ///< wanted size of texels, metres, > 0
  std::uint32_t most_side = 32;  ///< 2…kMostMapSide: texels along the longest side of an emitter with larger texels
  /// Rays of a texel for all its static lights together. A light has as many of them as it has of the texel's light, at
  /// least one, at most rays_per_light.
  std::uint32_t rays_per_texel = 64;
  std::uint32_t rays_per_light = 16;
  std::uint32_t visibility_rays = 16;  ///< of a texel for each dynamic light, at least 1
  bool operator==(const ParticleBakeOptions&) const = default;
};

/// Input of bake_particle_light(). `world`: as the world stage's systems left it, or just loaded. tracer: the triangles
/// that block light; for BakedMoment::at_rest only triangles that do not move.
struct ParticleBakeInput {
  const World& world;
  const SceneTracer& tracer;
  JobExecutor& executor;
  /// Reports texels that are done; called by one thread at a time; may be empty.
  std::function<void(std::size_t done, std::size_t total)> progress = {};
  ParticleBakeOptions options = {};
};

/// The maps of all emitters of the moment. Its lights are static, but for lights with a cookie: their light, with
/// traced shadows, and that of the sky and the ground is in the flux. Of the moment's lights that stay dynamic, the
/// strongest kBakedLights at an emitter have their visibility in its map. Version 0. The result depends on world,
/// triangles and options only, not on the executor.
[[nodiscard]] ParticleLightMaps bake_particle_light(const ParticleBakeInput& input);

/// Hash of everything that bake_particle_light() depends on: emitters, lights, sky, triangles and options. Maps with
/// another hash are out of date.
[[nodiscard]] std::uint64_t particle_light_content(const World& world, const SceneTracer& tracer,
                                                   const ParticleBakeOptions& options = {});

/// Sets static_state and dynamic_state of the maps: their light is that of the world's lights as they are now.
void mark_as_current(const World& world, ParticleLightMaps& maps);

/// The maps as bytes, for a cache; entities are named by their order in the world.
[[nodiscard]] std::string encode_particle_light(const World& world, const ParticleLightMaps& maps);
/// None if the bytes are not of encode_particle_light() or name an entity that the world does not have. The maps are
/// marked as current: call it only if particle_light_content() is that of the baked world.
[[nodiscard]] std::optional<ParticleLightMaps> decode_particle_light(const World& world, std::string_view bytes);

}  // namespace gloam
