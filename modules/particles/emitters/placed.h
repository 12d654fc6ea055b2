// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/ecs/view.h"
#include "engine/math/types.h"
#include "engine/render/packing/caster_bounds.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/posing/animation.h"
#include "engine/scene/resources.h"
#include "engine/schedule/parameters.h"
#include "modules/particles/components.h"
#include "modules/particles/emitters/path.h"
#include "modules/particles/emitters/pose_sampler.h"

namespace gloam {

/// Most particles of a world that are alive at once. With more, all emitters emit fewer by the same factor.
inline constexpr double kMostParticles = 1e6;

/// Where a moving emitter was. Members as in PlacedEmitter.
struct PlacedPose {
  double time_s = 0.0;
  dvec3 origin = dvec3(0.0);
  vec3 box[3] = {};
  vec3 axis = vec3(0.0f);
};

/// An emitter in the world.
struct PlacedEmitter {
  Entity entity = kNoEntity;
  ParticleEmitter values;     ///< finite, within the ranges of the scene keys
  double rate = 0.0;          ///< 1/s, > 0: values.rate, or less if the world has too many particles
  dvec3 origin = dvec3(0.0);  ///< the node's position
  vec3 box[3] = {};           ///< edges of the box, whose middle is the origin
  vec3 axis = vec3(0.0f);     ///< middle of the cone of directions, unit length: the node's +Y
  /// Of an emitter that has moved while a particle lives: its poses since the birth of the oldest one, in order of
  /// time. Two of the same time are a jump. Empty: it rests.
  std::vector<PlacedPose> path;
  WorldBox bounds;         ///< of all sprites at all times; with a path, of those that live
  float largest_m = 0.0f;  ///< greatest diameter of a sprite
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

/// Sets path and bounds of an emitter that place_emitter() has placed. Poses that are not finite are left out.
void place_path(const EmitterPath& path, PlacedEmitter& placed);

/// Lowers the rates of all emitters to kMostParticles in total. Returns the number of particles that are left out.
[[nodiscard]] double limit_particles(std::vector<PlacedEmitter>& emitters);

/// What tells where emitters were. Without an animation system there are no bindings, and hosts may have no teleports.
struct PathSources {
  const PlacingView& nodes;
  const AnimationBindings* bindings = nullptr;
  const SceneAssets* assets = nullptr;
  const Teleports* teleports = nullptr;
  SceneClock clock;
};
/// The path of an emitter that emits, by path.h. Empty: it rests. noted: what the world has noted of it; changed.
[[nodiscard]] EmitterPath find_path(const PathSources& sources, const PoseSampler* sampler, const PlacedEmitter& placed,
                                    const dmat4& matrix, EmitterPath& noted);

/// Gathers all emitters of the world, and the paths of those that move.
void particle_emitters_system(View<const ParticleEmitter, const WorldTransform> emitters, PlacingView nodes,
                              Resource<const SceneClock> clock, OptionalResource<const AnimationBindings> bindings,
                              OptionalResource<const SceneAssets> assets, OptionalResource<const Teleports> teleports,
                              Resource<EmitterPaths> paths, Resource<EmitterSet> set);

}  // namespace gloam
