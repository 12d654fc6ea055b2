// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/environment.h"
#include "modules/lighting/passes.h"
#include "shaders/lighting/shaders.h"

namespace gloam {

namespace {

gpu::GraphicsPipelineDesc deferred_pipeline(bool tiled, std::uint32_t directional_lights) {
  gpu::GraphicsPipelineDesc desc =
      fullscreen_pipeline((tiled ? "deferred/tiled/" : "deferred/brute/") + std::to_string(directional_lights), "lighting",
                          shaders::lighting::deferred_frag, gpu::Format::rgba16_float);
  desc.constants = {{0, tiled ? 1u : 0u}, {1, directional_lights}};
  return desc;
}

}  // namespace

Status add_deferred_pass(FrameBuilder& frame) {
  const FrameServices& services = frame.services();
  auto inputs = shading_inputs(frame);
  if (!inputs.ok()) return inputs.error();
  // Brute force draws the same picture while the tiled pipeline is made.
  if (inputs->tiled && !services.wait_for_pipelines)
    inputs->tiled = services.pipelines.request({deferred_pipeline(true, inputs->directional_count)}, services.log);
  auto pipeline = services.pipelines.get(deferred_pipeline(inputs->tiled, inputs->directional_count));
  if (!pipeline.ok()) return pipeline.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();

  const GeometryOutputs g = frame.get<GeometryOutputs>();
  const LightsOutputs* lights = frame.find<LightsOutputs>();
  // Without masks the shader does not look at the image, but every binding must be given.
  const ImageRef masks = inputs->tiled ? lights->tile_masks : g.normals;
  const ImageRef texels = lights != nullptr ? lights->texels : g.base_color;
  LitOutput& lit = frame.get<LitOutput>();
  PassBuilder pass = frame.graph().add_pass("deferred", "lighting");
  for (const ImageRef ref : {g.base_color, g.normals, g.material, g.emissive, g.depth}) pass.read(ref, gpu::Access::fragment_read);
  if (inputs->tiled) pass.read(masks, gpu::Access::fragment_read);
  if (lights != nullptr) pass.read(texels, gpu::Access::fragment_read);
  lit.color = pass.write(lit.color, gpu::Access::color_target);
  pass.execute([&frame, g, masks, texels, inputs = *inputs, color = lit.color, pipeline = *pipeline,
                sampler = *sampler](PassContext& context) {
    const auto sampled = [&](std::uint32_t binding, ImageRef ref) {
      return gpu::Binding{binding, gpu::Binding::Sampled{{.image = context.image(ref)}, sampler}};
    };
    FullscreenPass draw;
    draw.pipeline = pipeline;
    draw.bindings = {frame.view_binding(),   {1, inputs.lights},       {2, inputs.environment},
                     sampled(3, g.base_color), sampled(4, g.normals),  sampled(5, g.material),
                     sampled(6, g.emissive),   sampled(7, g.depth)};
    draw.bindings.push_back({8, gpu::Binding::Sampled{{.image = context.image(masks), .as_array = true}, sampler}});
    draw.bindings.push_back(sampled(9, texels));
    draw.target = context.image(color);
    draw.width = frame.view().width;
    draw.height = frame.view().height;
    record_fullscreen(context.commands(), draw);
  });
  return {};
}

}  // namespace gloam
