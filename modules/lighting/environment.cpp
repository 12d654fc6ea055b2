// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/environment.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "engine/scene/resources.h"
#include "engine/scene/transmission.h"
#include "modules/lighting/knobs.h"
#include "modules/lighting/occlusion_passes.h"
#include "modules/lighting/outputs.h"
#include "shaders/lighting/lighting_shared.h"

namespace gloam {

bool plain_highlights(const KnobRegistry& knobs) {
  return !wide_highlights(knobs) && !knobs.value(kSpecularAntialiasing);
}

namespace {

/// Fog before what surfaces mirror, all of it as far away as the sky.
void set_fog(const FrameBuilder& frame, shaders::SurroundingsConstants& constants) {
  constants.fog_through = 1.0f;
  const HomogeneousFog* fog = frame.find<HomogeneousFog>();
  if (fog == nullptr) return;
  constants.fog_through = std::exp(-fog->density * fog->sky_distance_m);
  constants.fog_light = fog->radiance * (frame.view().light_scale * (1.0f - constants.fog_through));
}

void add_surroundings(FrameBuilder& frame, ShadingInputs& inputs) {
  const SurroundingProbes* probes = frame.find<SurroundingProbes>();
  shaders::SurroundingsConstants constants{};
  if (probes != nullptr) {
    inputs.reflects = true;
    inputs.surroundings_follow = probes->surroundings_follow;
    inputs.probes = static_cast<std::uint32_t>(probes->rows.size());
    inputs.probe_images = probes->images;
    constants.probes = inputs.probes;
    constants.probe_scale = probes->scale;
    set_fog(frame, constants);
    std::copy_n(probes->rows.begin(), std::min<std::size_t>(inputs.probes, GLOAM_FEW_PROBES), constants.few_probes);
  }
  inputs.surroundings = frame.upload_uniform(constants);
  const shaders::ProbeRow no_row{};
  const vec4 no_factor(1.0f);
  const bool any = inputs.probes > 0, changed = probes != nullptr && !probes->factors.empty();
  inputs.probe_rows =
      frame.upload_items(any ? std::span<const shaders::ProbeRow>(probes->rows) : std::span(&no_row, 1));
  inputs.capture_factors =
      frame.upload_items(changed ? std::span<const vec4>(probes->factors) : std::span(&no_factor, 1));
}

void add_indirect_light(FrameBuilder& frame, ShadingInputs& inputs) {
  const IndirectLight* light = frame.find<IndirectLight>();
  if (light == nullptr) return;
  inputs.traced_indirect = light->traced;
  if (light->probes.empty()) return;
  const std::span<const shaders::DiffuseProbe> probes(light->probes);
  shaders::IndirectConstants constants{};
  constants.probes = static_cast<std::uint32_t>(probes.size());
  std::ranges::copy(probes.first(std::min<std::size_t>(probes.size(), GLOAM_FEW_PROBES)), constants.few_probes);
  inputs.indirect = 1 + probe_constant(probes.size());
  inputs.indirect_constants = frame.upload_uniform(constants);
  if (probes.size() > GLOAM_FEW_PROBES) inputs.diffuse_probes = frame.upload_items(probes);
}

gpu::Binding::BufferRange upload_environment(FrameBuilder& frame, const SceneEnvironment& sky, float scale) {
  return frame.upload_uniform(shaders::EnvironmentConstants{
      vec4(sky.sky_zenith * scale, 0.0f), vec4(sky.sky_horizon * scale, 0.0f), vec4(sky.sky_ground * scale, 0.0f)});
}

}  // namespace

const ShadingInputs& shading_inputs(FrameBuilder& frame) {
  if (const ShadingInputs* there = frame.find<ShadingInputs>()) return *there;
  ShadingInputs inputs;
  const auto& sky = frame.world().resource<SceneEnvironment>();
  const float scale = frame.view().light_scale;
  const bool left_out = frame.world().try_resource<SurroundingsLeftOut>() != nullptr;
  inputs.sky = upload_environment(frame, sky, scale);
  inputs.environment = left_out ? upload_environment(frame, sky, 0.0f) : inputs.sky;
  inputs.specular_ambient_taken = frame.find<SpecularAmbientTaken>() != nullptr;
  inputs.diffuse_light_wanted = frame.find<DiffuseLightWanted>() != nullptr;
  inputs.transmission = lets_light_through(frame.world());
  inputs.occlusion = occludes_ambient(frame);
  inputs.plain_highlights = plain_highlights(frame.knobs());
  add_surroundings(frame, inputs);
  add_indirect_light(frame, inputs);
  if (const LightsOutputs* lights = frame.find<LightsOutputs>()) {
    inputs.directional_count = lights->directional_count;
    inputs.outputs = *lights;
  } else if (const auto range = frame.services().uniforms.write(empty_light_block()); frame.check(range)) {
    inputs.outputs.lights = *range;
  }
  return frame.put(inputs);
}

gpu::SpecConstants indirect_constants(const ShadingInputs& inputs) {
  gpu::SpecConstants constants;
  if (inputs.indirect > 0) constants.set("kIndirect", inputs.indirect);
  return constants;
}

gpu::SpecConstants surroundings_constants(bool reflects, std::size_t probes) {
  gpu::SpecConstants constants;
  if (!reflects) return constants;
  constants.set("kReflects", 1u);
  constants.set("kProbes", probe_constant(probes));
  return constants;
}

void read_surroundings(ShaderPass& pass, FrameBuilder& frame) {
  const ShadingInputs& inputs = shading_inputs(frame);
  pass.read_if_declared("environment", inputs.environment);
  pass.read_if_declared("indirect", inputs.indirect_constants);
  pass.read_if_declared("diffuse_probes", inputs.diffuse_probes);
  pass.read_if_declared("surroundings", inputs.surroundings);
  pass.read_if_declared("probe_rows", inputs.probe_rows);
  pass.read_if_declared("capture_factors", inputs.capture_factors);
  pass.read_if_declared("probe_images", inputs.probe_images, Sampling::linear);
}

}  // namespace gloam
