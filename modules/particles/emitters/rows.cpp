// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/rows.h"

#include <algorithm>
#include <cmath>

#include "modules/particles/emitters/kinds.h"

namespace gloam {
namespace {

/// Speed at which turbulence widens a plume ÷ its greatest speed. It carries neighbours along together, which does not.
constexpr float kPlumeDrift = 0.2f;

/// Share of a plume's optical depth that shades its sides: sprites lie in heaps, between which light comes through.
constexpr float kPlumeShade = 0.82f;

std::uint32_t seed_of(Entity entity) { return (entity.index + 1) * 0x9E3779B9u; }

/// Phase of the turbulence at a step. Emitters have different ones.
float swirl_time(std::int64_t step, std::uint32_t seed) {
  const double turns = static_cast<double>(step) / (kParticleStepsPerSecond * GLOAM_PARTICLE_SWIRL_PERIOD);
  const double phase = turns + static_cast<double>(seed) / 4294967296.0;
  return static_cast<float>(phase - std::floor(phase));
}

/// Mean of sprite_shape.glsl over a disc, with noise of the mean 0.5 and the standard deviation 0.19.
float mean_shape(float erosion) {
  constexpr int kSteps = 16;
  float sum = 0.0f;
  for (int i = 0; i < kSteps; ++i)
    for (const float noise : {0.31f, 0.69f}) {
      const float inside = (static_cast<float>(i) + 0.5f) / kSteps;  // uniform over the disc
      const float body = std::clamp((inside + (noise - 1.0f) * erosion) / (1.0f - 0.6f * erosion), 0.0f, 1.0f);
      sum += inside * body * (2.0f - body);
    }
  return sum / (2.0f * kSteps);
}

/// How wide and how dense the plume is: across the axis, of all particles together.
void set_plume(const PlacedEmitter& emitter, const KindProperties& kind, shaders::ParticleEmitterRow& row) {
  const float c = std::cos(emitter.values.spread), speed = emitter.values.speed;
  row.mean_speed = 0.5f * (1.0f + c) * speed;
  // Cosines are uniform in c…1, and the squares of the factors of speed have the mean 1.053.
  row.way_wide2 = 1.053f * speed * speed * 0.5f * (1.0f - (1.0f + c + c * c) / 3.0f);
  float across = 0.0f;
  for (const vec3& edge : emitter.box) {
    const float along = glm::dot(edge, emitter.axis);
    across += std::max(glm::dot(edge, edge) - along * along, 0.0f);
  }
  row.birth_wide2 = across / 24.0f;  // two axes
  row.drift_wide2 = kPlumeDrift * kPlumeDrift * kind.turbulence * kind.turbulence;
  const float radius = 0.5f * emitter.values.size_m, inverse_life = 1.0f / emitter.values.lifetime_s;
  row.size_wide2 = 0.16f * radius * radius + 1e-30f;
  row.pace2_of_places = inverse_life * inverse_life;
  row.pace2_of_way =
      0.053f * row.mean_speed * row.mean_speed * row.pace2_of_places;  // variance of the factors of speed
  row.least_pace2 = 4.0f * row.drift_wide2 + 1e-30f;
  constexpr float kMiddle = 0.199471f;  // 1 / (2 √(2π)): half the depth through the middle of a normal distribution
  row.hiding = kMiddle * kPlumeShade * static_cast<float>(emitter.rate) * kPi * radius * radius * 1.02f *
               mean_shape(kind.erosion) * kind.cover;
}

void set_directions(const PlacedEmitter& emitter, shaders::ParticleEmitterRow& row) {
  row.axis = emitter.axis;
  const vec3 other = std::abs(row.axis.y) < 0.9f ? vec3(0.0f, 1.0f, 0.0f) : vec3(1.0f, 0.0f, 0.0f);
  row.across_x = glm::normalize(glm::cross(other, row.axis));
  row.across_y = glm::cross(row.axis, row.across_x);
  row.cos_spread = std::cos(emitter.values.spread);
}

void set_kind(const KindProperties& kind, shaders::ParticleEmitterRow& row) {
  row.drag = kind.drag;
  row.rise = kind.rise;
  row.turbulence = kind.turbulence;
  row.inverse_swirl = 1.0f / kind.swirl_m;
  row.growth = kind.growth;
  row.spin = kind.spin;
  row.opacity = kind.opacity;
  row.per_fade_in = 1.0f / kind.fade_in;
  row.per_fade_out = 1.0f / kind.fade_out;
  row.erosion = kind.erosion;
  row.cover = kind.cover;
  row.forward = kind.forward;
  row.albedo = kind.albedo;
  row.emission = kind.emission;
  row.cooled = kind.cooled;
}

void set_lights(const LightsOfEmitter& lights, const LightIndices& indices, shaders::ParticleEmitterRow& row) {
  for (std::uint32_t i = 0; i < lights.count; ++i) {
    const ChosenLight& light = lights.lights[i];
    const auto found = indices.find(light.entity);
    if (found == indices.end()) continue;
    const int at = static_cast<int>(row.light_count++);
    row.lights[at] = found->second;
    row.light_weights[at] = light.weight;
    row.light_channels[at] = light.channel;
  }
}

}  // namespace

shaders::ParticleEmitterRow emitter_row(const PlacedEmitter& emitter, const VisibleEmitter& visible,
                                        const LightsOfEmitter& lights, const LightIndices& indices,
                                        const RenderView& view, std::int64_t step, std::uint32_t first) {
  shaders::ParticleEmitterRow row{};
  row.origin = view.relative(emitter.origin);
  row.size_m = emitter.values.size_m;
  row.box_x = emitter.box[0];
  row.box_y = emitter.box[1];
  row.box_z = emitter.box[2];
  row.speed = emitter.values.speed;
  set_directions(emitter, row);
  const KindProperties kind = kind_of(emitter.values);
  set_kind(kind, row);
  set_plume(emitter, kind, row);
  row.emission *= view.light_scale;
  row.seed = seed_of(emitter.entity);
  row.oldest = static_cast<std::uint32_t>(visible.live.oldest);
  row.count = visible.live.count;
  row.first = first;
  row.oldest_age_s = static_cast<float>(visible.live.oldest_age_s);
  row.interval_s = static_cast<float>(1.0 / emitter.rate);
  row.inverse_life = 1.0f / emitter.values.lifetime_s;
  row.swirl_step_s = emitter.values.lifetime_s / GLOAM_PARTICLE_SWIRL_STEPS;
  row.step_decay = std::exp(-row.drag * row.swirl_step_s);
  row.step_way = -std::expm1(-row.drag * row.swirl_step_s) / row.drag;
  row.swirl_time = swirl_time(step, row.seed);
  row.map_slice = -1.0f;
  set_lights(lights, indices, row);
  return row;
}

void add_path(const PlacedEmitter& emitter, const RenderView& view, std::int64_t step, shaders::ParticleEmitterRow& row,
              std::vector<shaders::ParticlePose>& poses) {
  const double time_s = static_cast<double>(step) / kParticleStepsPerSecond;
  row.path_first = static_cast<std::uint32_t>(poses.size());
  row.path_poses = static_cast<std::uint32_t>(emitter.path.size());
  for (const PlacedPose& pose : emitter.path) {
    shaders::ParticlePose& added = poses.emplace_back();
    added.origin = view.relative(pose.origin);
    added.age_s = static_cast<float>(time_s - pose.time_s);
    added.box_x = pose.box[0];
    added.box_y = pose.box[1];
    added.box_z = pose.box[2];
    added.axis = pose.axis;
  }
}

}  // namespace gloam
