// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/outputs.h"

#include <algorithm>

#include "engine/math/packing.h"
#include "engine/scene/transmission.h"
#include "modules/lighting/environment.h"
#include "modules/shadows/outputs.h"

namespace gloam {
namespace {

ForwardShadows version_of(const ShadowsOutputs& shadows) {
  if (shadows.cookies_only) return ForwardShadows::cookies;
  return shadows.standard ? ForwardShadows::standard : ForwardShadows::all;
}

}  // namespace

vec3 decode_diffuse_light(uvec2 texel) {
  const auto half = [](std::uint32_t bits) { return half_to_float(static_cast<std::uint16_t>(bits)); };
  return {half(texel.x), half(texel.x >> 16), half(texel.y)};
}

std::uint32_t probe_constant(std::size_t rows) {
  return static_cast<std::uint32_t>(std::min<std::size_t>(rows, GLOAM_FEW_PROBES + 1));
}

gpu::SpecConstants probe_constants(std::size_t rows, bool factors) {
  return {{"kProbes", probe_constant(rows)}, {"kFactors", factors ? 1u : 0u}};
}

gpu::SpecConstants indirect_constants(const FrameBuilder& frame) {
  gpu::SpecConstants constants;
  const IndirectLight* light = frame.find<IndirectLight>();
  if (light != nullptr && !light->probes.empty()) constants.set("kIndirect", 1 + probe_constant(light->probes.size()));
  return constants;
}

ForwardLighting forward_lighting(const LightsOutputs* lights, const ShadowsOutputs* shadows) {
  ForwardLighting version;
  version.tiled = lights != nullptr && lights->has_lists();
  if (shadows != nullptr) {
    version.shadows = version_of(*shadows);
    version.constants = shadows->constants;
  }
  return version;
}

ForwardLighting forward_lighting(const FrameBuilder& frame) {
  ForwardLighting version = forward_lighting(frame.find<LightsOutputs>(), frame.find<ShadowsOutputs>());
  if (lets_light_through(frame.world())) version.constants.set_if_present("kTransmission", 1u);
  if (const SurroundingProbes* probes = frame.find<SurroundingProbes>())
    version.constants.set(surroundings_constants(true, probes->rows.size()).where_present());
  version.constants.set(indirect_constants(frame).where_present());
  return version;
}

void read_lighting(ShaderPass& pass, FrameBuilder& frame) {
  const ShadingInputs& inputs = shading_inputs(frame);
  read_surroundings(pass, frame);
  read_light_lists(pass, inputs.outputs);
  if (const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>()) read_shadows(pass, *shadows);
}

}  // namespace gloam
