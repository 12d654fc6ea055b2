// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/particle_passes.h"

#include <algorithm>
#include <span>
#include <vector>

#include "engine/scene/resources.h"
#include "modules/lights/outputs.h"
#include "modules/particles/drawing/draw_sprites_pass.h"
#include "modules/particles/emitters/rows.h"
#include "modules/particles/emitters/strongest_lights.h"
#include "modules/particles/emitters/visible.h"
#include "modules/particles/lighting/atlas.h"
#include "modules/particles/lighting/light_sprites_pass.h"
#include "modules/particles/simulation/simulate_particles_pass.h"
#include "modules/particles/sorting/key_ranges.h"
#include "modules/particles/sorting/sort_particles_passes.h"

namespace gloam {
namespace {

LightIndices light_indices(const FrameBuilder& frame) {
  LightIndices indices;
  if (frame.find<LightsOutputs>() == nullptr) return indices;
  const auto& visible = frame.world().view_resource<VisibleLights>(frame.view().id);
  std::uint32_t next = 0;
  for (const Entity light : local_lights(visible)) indices.emplace(light, next++);
  next = GLOAM_PARTICLE_DIRECTIONAL;
  for (const Entity light : directional_lights(visible)) indices.emplace(light, next++);
  return indices;
}

/// Radiance of a white particle in the mean light of sky and ground.
vec3 mean_light(const World& world) {
  const auto& sky = world.resource<SceneEnvironment>();
  return 0.5f * (sky.sky_ground + 0.5f * (sky.sky_horizon + sky.sky_zenith));
}

shaders::ParticleFrame view_part(const RenderView& view) {
  shaders::ParticleFrame constants{};
  for (std::size_t i = 0; i < 4; ++i)
    constants.planes[i] = vec4(view.frustum.planes[i].normal, view.frustum.planes[i].distance);
  const mat4& m = view.view_from_relative;
  constants.right = vec3(m[0][0], m[1][0], m[2][0]);
  constants.up = vec3(m[0][1], m[1][1], m[2][1]);
  constants.near_m = view.near_m;
  return constants;
}

/// The rows of all emitters in view and the emitter of each group of places.
struct Rows {
  std::vector<shaders::ParticleEmitterRow> emitters;
  std::vector<shaders::ParticlePose> poses;  ///< at least one
  std::vector<std::uint32_t> groups;
};

Rows make_rows(const FrameBuilder& frame, const VisibleEmitters& visible, bool two_digits, const AtlasPlan& plan) {
  const World& world = frame.world();
  const std::vector<PlacedEmitter>& emitters = world.resource<EmitterSet>().emitters;
  const EmitterLights& lights = world.resource<EmitterLights>();
  const ParticleLightMaps& maps = world.resource<ParticleLightMaps>();
  const LightIndices indices = light_indices(frame);
  const std::vector<KeyRange> keys = key_ranges(visible.emitters, two_digits ? kTwoDigitKeys : kOneDigitKeys);
  Rows rows;
  for (std::size_t i = 0; i < visible.emitters.size(); ++i) {
    const VisibleEmitter& seen = visible.emitters[i];
    const PlacedEmitter& emitter = emitters[seen.emitter];
    const auto first = static_cast<std::uint32_t>(rows.groups.size() * GLOAM_PARTICLE_GROUP);
    shaders::ParticleEmitterRow row =
        emitter_row(emitter, seen, lights.emitters[seen.emitter], indices, frame.view(), visible.step, first);
    row.first_key = keys[i].first;
    row.keys = keys[i].count;
    row.far_m = static_cast<float>(keys[i].far_m);
    row.keys_per_m = static_cast<float>(keys[i].keys_per_m);
    if (const std::uint32_t map = lights.emitters[seen.emitter].map; map != ~0u)
      set_map(maps.maps[map], plan.first_slice[map], frame.view(), row);
    add_path(emitter, frame.view(), visible.step, row, rows.poses);
    const std::size_t groups = (row.count + GLOAM_PARTICLE_GROUP - 1) / GLOAM_PARTICLE_GROUP;
    rows.groups.insert(rows.groups.end(), groups, static_cast<std::uint32_t>(i));
    rows.emitters.push_back(row);
  }
  if (rows.poses.empty()) rows.poses.emplace_back();  // a binding must not be empty
  return rows;
}

ParticleInputs upload_inputs(FrameBuilder& frame, const VisibleEmitters& visible) {
  const ParticleLightMaps& maps = frame.world().resource<ParticleLightMaps>();
  ParticleInputs inputs;
  inputs.lighting = maps.per_pixel ? ParticleLighting::pixel : particle_lighting(frame.knobs());
  inputs.particles = static_cast<std::uint32_t>(visible.particles);
  inputs.two_digits = inputs.particles > kMostOneDigitParticles || visible.emitters.size() > kOneDigitKeys;
  const bool lit = inputs.lighting != ParticleLighting::off;
  const AtlasPlan plan = plan_atlas(maps.maps);
  if (lit) inputs.atlas = add_atlas(frame, maps, plan);
  const Rows rows = make_rows(frame, visible, inputs.two_digits, plan);
  inputs.constants = view_part(frame.view());
  inputs.constants.places = static_cast<std::uint32_t>(rows.groups.size() * GLOAM_PARTICLE_GROUP);
  inputs.constants.culled_key = inputs.two_digits ? 0xFFFFu : 0xFFu;
  inputs.constants.unlit = mean_light(frame.world());
  inputs.constants.atlas_scale = 1.0f / glm::max(vec3(plan.size), vec3(1.0f));
  inputs.constants_range = frame.upload_uniform(inputs.constants);
  inputs.emitters = frame.upload_items(std::span<const shaders::ParticleEmitterRow>(rows.emitters));
  inputs.poses = frame.upload_items(std::span<const shaders::ParticlePose>(rows.poses));
  inputs.dispatches = simulation_dispatches(rows.groups);
  const auto moves = [](const shaders::ParticleEmitterRow& row) { return row.path_poses > 0; };
  const bool any_moves = std::ranges::any_of(rows.emitters, moves);
  for (SimulationDispatch& dispatch : inputs.dispatches)
    dispatch.paths = dispatch.one_emitter ? moves(rows.emitters[dispatch.constants.row]) : any_moves;
  inputs.groups = frame.upload_items(std::span<const std::uint32_t>(rows.groups));
  return inputs;
}

}  // namespace

void add_particle_passes(FrameBuilder& frame) {
  const VisibleEmitters& visible = frame.world().view_resource<VisibleEmitters>(frame.view().id);
  if (visible.emitters.empty()) return;
  const ParticleInputs inputs = upload_inputs(frame, visible);
  if (!frame.status().ok()) return;
  const SimulatedParticles simulated = add_particle_simulation_pass(frame, inputs);
  const SortedParticles sorted =
      add_particle_sort_passes(frame, simulated.keys, inputs.constants.places, inputs.two_digits);
  BufferRef light;
  if (lit_points(inputs.lighting) > 0) light = add_particle_light_pass(frame, inputs, simulated, sorted);
  add_sprite_pass(frame, frame.put(ParticlesFrame{inputs, simulated, sorted, light}));
}

void list_particle_pipelines(ParticleLighting lighting, const ParticleLightVersion& version, bool jittered,
                             bool threads_in_turn, PipelineList& list) {
  const auto add = [&](const ComputeProgram& program) { list.push_back(pipeline_desc(program, "particles")); };
  for (const bool one_emitter : {true, false})
    for (const bool paths : {true, false}) add(particle_simulation_program(one_emitter, paths));
  for (const ComputeProgram& program : particle_sort_programs(threads_in_turn)) add(program);
  const std::uint32_t points = lit_points(lighting);
  if (points > 0) add(particle_light_program(version, points));
  const gpu::Format formats[] = {gpu::Format::rgba16_float};
  const bool per_pixel = lighting == ParticleLighting::pixel;
  list.push_back(pipeline_desc(sprite_program(points, false, jittered, per_pixel ? &version : nullptr), "particles",
                               formats, kGeometryDepthFormat));
}

}  // namespace gloam
