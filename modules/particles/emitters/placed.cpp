// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/placed.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/math/finite.h"
#include "modules/particles/emitters/births.h"
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

/// The values' pose at a matrix; none if it is not finite.
std::optional<PlacedPose> pose_of(const ParticleEmitter& values, const dmat4& world_from_node) {
  if (!has_finite_columns(world_from_node)) return std::nullopt;
  PlacedPose pose;
  pose.origin = dvec3(world_from_node[3]);
  for (int i = 0; i < 3; ++i) {
    pose.box[i] = vec3(dvec3(world_from_node[i]) * static_cast<double>(values.box_m[i]));
    if (!is_finite(pose.box[i])) return std::nullopt;
  }
  const dvec3 up(world_from_node[1]);
  const double length = glm::length(up);
  pose.axis = length > 0.0 && std::isfinite(length) ? vec3(up / length) : vec3(0.0f, 1.0f, 0.0f);
  return pose;
}

void take_pose(const PlacedPose& pose, PlacedEmitter& placed) {
  placed.origin = pose.origin;
  for (std::size_t i = 0; i < 3; ++i) placed.box[i] = pose.box[i];
  placed.axis = pose.axis;
}

/// Whether the host has put the node or an ancestor elsewhere.
bool is_teleported(const PathSources& sources, Entity node) {
  if (sources.teleports == nullptr || sources.teleports->entities.empty()) return false;
  while (true) {
    if (std::ranges::find(sources.teleports->entities, node) != sources.teleports->entities.end()) return true;
    const Parent* parent = sources.nodes.try_get<const Parent>(node);
    if (parent == nullptr) return false;
    node = parent->entity;
  }
}

}  // namespace

bool emits(const ParticleEmitter& emitter) {
  return emitter.kind != EmitterKind::none && emitter.rate > 0.0f && emitter.lifetime_s > 0.0f;
}

bool place_emitter(Entity entity, const ParticleEmitter& emitter, const dmat4& world_from_node, PlacedEmitter& placed) {
  if (!has_finite_values(emitter)) return false;
  placed = {};
  placed.entity = entity;
  placed.values = clamped(emitter);
  placed.rate = static_cast<double>(placed.values.rate);
  const std::optional<PlacedPose> pose = pose_of(placed.values, world_from_node);
  if (!pose) return false;
  take_pose(*pose, placed);
  placed.largest_m = largest_sprite_m(placed.values);
  placed.bounds = emitter_bounds(placed);
  return placed.bounds.known();
}

void place_path(const EmitterPath& path, PlacedEmitter& placed) {
  placed.path.clear();
  PlacedEmitter at = placed;
  for (const TimedPose& timed : path) {
    std::optional<PlacedPose> pose = pose_of(placed.values, timed.matrix);
    if (!pose) continue;
    take_pose(*pose, at);
    const WorldBox bounds = emitter_bounds(at);
    if (!bounds.known()) continue;
    placed.bounds.min = glm::min(placed.bounds.min, bounds.min);
    placed.bounds.max = glm::max(placed.bounds.max, bounds.max);
    pose->time_s = timed.time_s;
    placed.path.push_back(*pose);
  }
}

EmitterPath find_path(const PathSources& sources, const PoseSampler* sampler, const PlacedEmitter& placed,
                      const dmat4& matrix, EmitterPath& noted) {
  // Ages are counted in steps.
  const double time_s = static_cast<double>(particle_step(sources.clock.time_s)) / kParticleStepsPerSecond;
  const double lifetime_s = static_cast<double>(placed.values.lifetime_s);
  if (sampler != nullptr && sampler->moves(placed.entity)) {
    noted.clear();
    const double least_jump = 0.05 / static_cast<double>(placed.values.metres_per_unit);
    EmitterPath path = sampled_path([&](double at) { return sampler->world_from_node(placed.entity, at); }, time_s,
                                    lifetime_s, least_jump);
    return rests(path) ? EmitterPath() : path;
  }
  const bool stands = sources.clock.dt_s == 0.0 && !noted.empty() && noted.back().time_s == time_s;
  note_pose(noted, time_s, matrix, stands || is_teleported(sources, placed.entity), lifetime_s);
  return noted.size() > 1 ? noted : EmitterPath();
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

void particle_emitters_system(View<const ParticleEmitter, const WorldTransform> emitters, PlacingView nodes,
                              Resource<const SceneClock> clock, OptionalResource<const AnimationBindings> bindings,
                              OptionalResource<const SceneAssets> assets, OptionalResource<const Teleports> teleports,
                              Resource<EmitterPaths> paths, Resource<EmitterSet> set) {
  const PathSources sources = {nodes, bindings.get(), assets.get(), teleports.get(), *clock};
  std::optional<PoseSampler> sampler;
  if (sources.bindings != nullptr && sources.assets != nullptr && !sources.bindings->poses.empty())
    sampler.emplace(nodes, *sources.bindings, *sources.assets);
  EmitterSet found;
  EmitterPaths noted;  // without those of emitters that are gone
  emitters.each([&](Entity entity, const ParticleEmitter& emitter, const WorldTransform& transform) {
    if (!emits(emitter)) return;
    PlacedEmitter placed;
    if (!place_emitter(entity, emitter, transform.matrix, placed)) {
      ++found.unusable;
      return;
    }
    EmitterPath& path = noted.paths[entity];
    if (const auto before = paths->paths.find(entity); before != paths->paths.end()) path = std::move(before->second);
    place_path(find_path(sources, sampler ? &*sampler : nullptr, placed, transform.matrix, path), placed);
    found.emitters.push_back(std::move(placed));
  });
  std::ranges::sort(found.emitters, {}, [](const PlacedEmitter& e) { return e.entity.index; });
  found.left_out = limit_particles(found.emitters);
  *paths = std::move(noted);
  *set = std::move(found);
}

}  // namespace gloam
