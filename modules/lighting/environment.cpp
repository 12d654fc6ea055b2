// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/environment.h"

#include "engine/scene/resources.h"
#include "shaders/lighting/lighting_shared.h"

namespace gloam {

Result<ShadingInputs> shading_inputs(FrameBuilder& frame) {
  if (const ShadingInputs* there = frame.find<ShadingInputs>()) return *there;
  ShadingInputs inputs;
  const auto& sky = frame.world().resource<SceneEnvironment>();
  const shaders::EnvironmentConstants constants{vec4(sky.sky_zenith, 0.0f), vec4(sky.sky_horizon, 0.0f),
                                                vec4(sky.sky_ground, 0.0f)};
  auto environment = frame.services().uniforms.write_value(constants);
  if (!environment.ok()) return environment.error();
  inputs.environment = *environment;
  if (const LightsOutputs* lights = frame.find<LightsOutputs>()) {
    inputs.lights = lights->lights;
    inputs.directional_count = lights->directional_count;
    inputs.outputs = *lights;
  } else {
    auto range = frame.services().uniforms.write(empty_light_block());
    if (!range.ok()) return range.error();
    inputs.lights = *range;
  }
  return frame.put(inputs);
}

}  // namespace gloam
