// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/placed.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/math/finite.h"
#include "modules/particles/emitters/bounds.h"

namespace gloam {
namespace {

bool has_finite_values(const ParticleEmitter& e) {
  return std::isfinite(e.rate) && std::isfinite(e.lifetime_s) && std::isfinite(e.size_m) && std::isfinite(e.speed) &&
         std::isfinite(e.spread) && is_finite(e.box_m) && std::isfinite(1.0f / e.metres_per_unit) &&
         e.metres_per_unit > 0.0f;
}

bool has_finite_columns(const dmat4& m) {
  for (int i = 0; i < 4; ++i)
    if (!is_finite(dvec3(m[i]))) return false;
  return true;
}

/// The values within the ranges of the scene keys.
ParticleEmitter clamped(ParticleEmitter e) {
  e.rate = std::clamp(e.rate, 1e-9f, 1e6f);  // the time between births is finite
  e.lifetime_s = std::clamp(e.lifetime_s, 1e-3f, 1e4f);
  e.size_m = std::clamp(e.size_m, 0.0f, std::max(1e3f, 1e3f / e.metres_per_unit));
  e.speed = std::clamp(e.speed, 0.0f, 1e3f / e.metres_per_unit);
  e.spread = std::clamp(e.spread, 0.0f, kPi);
  e.box_m = glm::clamp(e.box_m, vec3(0.0f), vec3(std::max(1e6f, 1e6f / e.metres_per_unit)));
  return e;
}

}  // namespace

bool emits(const ParticleEmitter& emitter) {
  return emitter.kind != EmitterKind::none && emitter.rate > 0.0f && emitter.lifetime_s > 0.0f;
}

bool place_emitter(Entity entity, const ParticleEmitter& emitter, const dmat4& world_from_node, PlacedEmitter& placed) {
  if (!has_finite_values(emitter) || !has_finite_columns(world_from_node)) return false;
  placed = {};
  placed.entity = entity;
  placed.values = clamped(emitter);
  placed.rate = static_cast<double>(placed.values.rate);
  placed.origin = dvec3(world_from_node[3]);
  for (int i = 0; i < 3; ++i) {
    placed.box[i] = vec3(dvec3(world_from_node[i]) * static_cast<double>(placed.values.box_m[i]));
    if (!is_finite(placed.box[i])) return false;
  }
  const dvec3 up(world_from_node[1]);
  const double length = glm::length(up);
  placed.axis = length > 0.0 && std::isfinite(length) ? vec3(up / length) : vec3(0.0f, 1.0f, 0.0f);
  placed.largest_m = largest_sprite_m(placed.values);
  placed.bounds = emitter_bounds(placed);
  return placed.bounds.known();
}

double limit_particles(std::vector<PlacedEmitter>& emitters) {
  double all = 0.0;
  // One more than the mean number may be alive.
  for (const PlacedEmitter& e : emitters) all += e.rate * static_cast<double>(e.values.lifetime_s) + 1.0;
  if (all <= kMostParticles) return 0.0;
  const double room = std::max(kMostParticles - static_cast<double>(emitters.size()), 0.0);
  const double factor = room / (all - static_cast<double>(emitters.size()));
  for (PlacedEmitter& e : emitters) e.rate *= factor;
  return all - kMostParticles;
}

void particle_emitters_system(View<const ParticleEmitter, const WorldTransform> emitters, Resource<EmitterSet> set) {
  EmitterSet found;
  emitters.each([&](Entity entity, const ParticleEmitter& emitter, const WorldTransform& transform) {
    if (!emits(emitter)) return;
    PlacedEmitter placed;
    if (place_emitter(entity, emitter, transform.matrix, placed))
      found.emitters.push_back(placed);
    else
      ++found.unusable;
  });
  std::ranges::sort(found.emitters, {}, [](const PlacedEmitter& e) { return e.entity.index; });
  found.left_out = limit_particles(found.emitters);
  *set = std::move(found);
}

}  // namespace gloam
