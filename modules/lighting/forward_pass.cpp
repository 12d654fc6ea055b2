// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/draw_pass.h"
#include "modules/lighting/lighting_passes.h"
#include "modules/lighting/outputs.h"
#include "shaders/lighting/shaders.h"

namespace gloam {
namespace {

gpu::ShaderCode shading_code(bool tiled, ForwardShadows shadows) {
  using namespace shaders::lighting;
  switch (shadows) {
    case ForwardShadows::cookies:
      return tiled ? forward_tiled_cookies_frag : forward_cookies_frag;
    case ForwardShadows::standard:
      return tiled ? forward_tiled_shadowed_standard_frag : forward_shadowed_standard_frag;
    case ForwardShadows::all:
      return tiled ? forward_tiled_shadowed_frag : forward_shadowed_frag;
    default:
      return tiled ? forward_tiled_frag : forward_frag;
  }
}

SurfacePass forward_surface_pass(const ForwardLighting& version) {
  SurfacePass pass;
  pass.module = "lighting";
  pass.fragment = shading_code(version.tiled, version.shadows);
  pass.color_formats = {gpu::Format::rgba16_float};
  pass.blend = gpu::BlendMode::alpha;
  pass.depth_write = false;
  pass.constants = version.constants;
  return pass;
}

/// The surface pass of the best version whose pipelines are ready. While tiled pipelines are built, the pass loops over
/// all lights, which gives the same picture. While shadowed pipelines are built, the picture has no shadows.
SurfacePass choose_version(FrameBuilder& frame) {
  const std::span<const Draw> draws = frame.draws().blended;
  const ForwardLighting best = forward_lighting(frame);
  const SurfacePass wanted = forward_surface_pass(best);
  if (frame.services().wait_for_pipelines) return wanted;
  if (best.shadows != ForwardShadows::none) {
    if (frame.request_surfaces(draws, wanted)) return wanted;
    const SurfacePass all_lights = forward_surface_pass({false, best.shadows, best.constants});
    if (best.tiled && frame.has_surfaces(draws, all_lights)) return all_lights;
  }
  const ShadingInputs& inputs = shading_inputs(frame);
  gpu::SpecConstants constants = surroundings_constants(inputs.reflects, inputs.probes);
  constants.set(indirect_constants(inputs));
  const SurfacePass unshadowed = forward_surface_pass({.tiled = best.tiled, .constants = constants});
  if (!best.tiled || frame.request_surfaces(draws, unshadowed)) return unshadowed;
  return forward_surface_pass({.constants = constants});
}

}  // namespace

void list_forward_pipelines(const ShadingInputs& inputs, const ShadowsOutputs& shadows,
                            std::span<const SurfaceVariant> variants, PipelineList& list) {
  ForwardLighting version = forward_lighting(&inputs.outputs, &shadows);
  version.constants.set(surroundings_constants(inputs.reflects, inputs.probes).where_present());
  version.constants.set(indirect_constants(inputs).where_present());
  const SurfacePass pass = forward_surface_pass(version);
  for (const SurfaceVariant& variant : variants) list.push_back(surface_pipeline_desc(pass, variant));
}

void add_blended_layer_passes(FrameBuilder& frame) {
  const std::span<const Draw> draws = frame.draws().blended;
  if (draws.empty() || frame.find<BlendedLayerWanted>() == nullptr) return;
  const SurfacePass depths = front_depth_surface_pass();
  if (!frame.services().wait_for_pipelines && !frame.request_surfaces(draws, depths)) return;
  const ImageRef opaque = frame.get<GeometryOutputs>().depth;
  BlendedLayer layer;
  {
    DrawPass pass(frame, "blended_layer");
    layer.light = pass.target(create_view_image(frame, "blended_light", gpu::Format::rgba16_float), gpu::LoadOp::clear);
    pass.test_depth(opaque);
    pass.use(choose_version(frame));
    read_lighting(pass, frame);
    pass.surfaces(draws);
  }
  DrawPass pass(frame, "blended_layer_depth");
  layer.depth = pass.target(create_view_image(frame, "blended_depth", depths.color_formats[0]), gpu::LoadOp::clear);
  pass.test_depth(opaque);
  pass.use(depths);
  pass.surfaces(draws);
  frame.put(layer);
}

void add_forward_pass(FrameBuilder& frame) {
  if (frame.draws().blended.empty()) return;
  LitOutput& lit = frame.get<LitOutput>();
  DrawPass pass(frame, "forward");
  lit.color = pass.target(lit.color, gpu::LoadOp::load);
  pass.test_depth(frame.get<GeometryOutputs>().depth);
  pass.use(choose_version(frame));
  read_lighting(pass, frame);
  pass.surfaces(frame.draws().blended);
}

}  // namespace gloam
