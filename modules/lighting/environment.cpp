// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/environment.h"

#include "engine/scene/resources.h"
#include "engine/scene/transmission.h"
#include "modules/lighting/knobs.h"
#include "modules/lighting/outputs.h"
#include "shaders/lighting/lighting_shared.h"

namespace gloam {

bool plain_highlights(const KnobRegistry& knobs) {
  return !wide_highlights(knobs) && !knobs.value(kSpecularAntialiasing);
}

const ShadingInputs& shading_inputs(FrameBuilder& frame) {
  if (const ShadingInputs* there = frame.find<ShadingInputs>()) return *there;
  ShadingInputs inputs;
  const auto& sky = frame.world().resource<SceneEnvironment>();
  const float scale = frame.view().light_scale;
  inputs.environment = frame.upload_uniform(shaders::EnvironmentConstants{
      vec4(sky.sky_zenith * scale, 0.0f), vec4(sky.sky_horizon * scale, 0.0f), vec4(sky.sky_ground * scale, 0.0f)});
  inputs.specular_ambient_taken = frame.find<SpecularAmbientTaken>() != nullptr;
  inputs.diffuse_light_wanted = frame.find<DiffuseLightWanted>() != nullptr;
  inputs.transmission = lets_light_through(frame.world());
  inputs.plain_highlights = plain_highlights(frame.knobs());
  if (const LightsOutputs* lights = frame.find<LightsOutputs>()) {
    inputs.directional_count = lights->directional_count;
    inputs.outputs = *lights;
  } else if (const auto range = frame.services().uniforms.write(empty_light_block()); frame.check(range)) {
    inputs.outputs.lights = *range;
  }
  return frame.put(inputs);
}

}  // namespace gloam
