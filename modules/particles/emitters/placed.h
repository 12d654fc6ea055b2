// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/ecs/view.h"
#include "engine/math/types.h"
#include "engine/render/packing/caster_bounds.h"
#include "engine/scene/components.h"
#include "engine/schedule/parameters.h"
#include "modules/particles/components.h"

namespace gloam {

/// Most particles of a world that are alive at once. With more, all emitters emit fewer by the same factor.
inline constexpr double kMostParticles = 1e6;

/// An emitter in the world.
struct PlacedEmitter {
  Entity entity = kNoEntity;
  ParticleEmitter values;     ///< finite, within the ranges of the scene keys
  double rate = 0.0;          ///< 1/s, > 0: values.rate, or less if the world has too many particles
  dvec3 origin = dvec3(0.0);  ///< the node's position
  vec3 box[3] = {};           ///< edges of the box, whose middle is the origin
  vec3 axis = vec3(0.0f);     ///< middle of the cone of directions, unit length: the node's +Y
  WorldBox bounds;            ///< of all sprites at all times
  float largest_m = 0.0f;     ///< greatest diameter of a sprite
};

/// All emitters of the world by entity index; a world resource written by system particle_emitters.
struct EmitterSet {
  std::vector<PlacedEmitter> emitters;
  std::uint32_t unusable = 0;  ///< emitters with NaN or infinity in a value or in their matrix
  double left_out = 0.0;       ///< particles beyond kMostParticles, which are not emitted
};

/// Whether an emitter emits anything: it has a kind, a rate > 0 and a lifetime > 0.
[[nodiscard]] bool emits(const ParticleEmitter& emitter);

/// Places an emitter at its node; `rate` is the emitter's own. False, with `placed` undefined, if a value or the matrix
/// is NaN or infinite. emitter: emits().
[[nodiscard]] bool place_emitter(Entity entity, const ParticleEmitter& emitter, const dmat4& world_from_node,
                                 PlacedEmitter& placed);

/// Lowers the rates of all emitters to kMostParticles in total. Returns the number of particles that are left out.
[[nodiscard]] double limit_particles(std::vector<PlacedEmitter>& emitters);

/// Gathers all emitters of the world.
void particle_emitters_system(View<const ParticleEmitter, const WorldTransform> emitters, Resource<EmitterSet> set);

}  // namespace gloam
