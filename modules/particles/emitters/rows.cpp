// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/rows.h"

#include <algorithm>
#include <cmath>

#include "modules/particles/emitters/kinds.h"

namespace gloam {
namespace {

std::uint32_t seed_of(Entity entity) { return (entity.index + 1) * 0x9E3779B9u; }

/// Phase of the turbulence at a step. Emitters have different ones.
float swirl_time(std::int64_t step, std::uint32_t seed) {
  const double turns = static_cast<double>(step) / (kParticleStepsPerSecond * GLOAM_PARTICLE_SWIRL_PERIOD);
  const double phase = turns + static_cast<double>(seed) / 4294967296.0;
  return static_cast<float>(phase - std::floor(phase));
}

/// Distance of most particles from the column above the emitter.
float usual_radius(const PlacedEmitter& emitter) {
  const KindProperties kind = kind_of(emitter.values);
  const float life = emitter.values.lifetime_s, way = (1.0f - std::exp(-kind.drag * life)) / kind.drag;
  float box = 0.0f;
  for (const vec3& edge : emitter.box) box = std::max({box, std::abs(edge.x), std::abs(edge.z)});
  const float sideways = emitter.values.speed * std::sin(std::min(emitter.values.spread, 0.5f * kPi)) * way;
  return 0.25f * box + 0.4f * sideways + 0.1f * kind.turbulence * life + 0.1f * emitter.largest_m +
         1e-4f / emitter.values.metres_per_unit;
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
  row.fade_in = kind.fade_in;
  row.fade_out = kind.fade_out;
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
  set_kind(kind_of(emitter.values), row);
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
  row.inverse_radius = 1.0f / usual_radius(emitter);
  row.map_slice = -1.0f;
  set_lights(lights, indices, row);
  return row;
}

}  // namespace gloam
