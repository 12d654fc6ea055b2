// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/passes/passes.h"
#include "shaders/render/shaders.h"

namespace gloam {

Status add_debug_view_pass(FrameBuilder& frame, std::uint32_t code) {
  GLOAM_TRY(frame.upload_view_constants(code));
  const FrameServices& services = frame.services();
  TargetOutput& target = frame.get<TargetOutput>();
  gpu::GraphicsPipelineDesc desc = fullscreen_pipeline("debug_view/" + std::string(gpu::name_of(target.format)),
                                                       "engine", shaders::render::debug_view_frag, target.format);
  desc.constants = {{0, gpu::encodes_srgb(target.format) ? 0u : 1u}};
  auto pipeline = services.pipelines.get(desc);
  if (!pipeline.ok()) return pipeline.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();

  const GeometryOutputs outputs = frame.get<GeometryOutputs>();
  PassBuilder pass = frame.graph().add_pass("debug_view", "engine");
  for (const ImageRef ref : {outputs.base_color, outputs.normals, outputs.depth})
    pass.read(ref, gpu::Access::fragment_read);
  target.color = pass.write(target.color, gpu::Access::color_target);
  pass.execute([&frame, outputs, color = target.color, pipeline = *pipeline, sampler = *sampler](PassContext& context) {
    FullscreenPass draw;
    draw.pipeline = pipeline;
    draw.bindings = {frame.view_binding(),
                     {1, gpu::Binding::Sampled{{.image = context.image(outputs.base_color)}, sampler}},
                     {2, gpu::Binding::Sampled{{.image = context.image(outputs.normals)}, sampler}},
                     {3, gpu::Binding::Sampled{{.image = context.image(outputs.depth)}, sampler}}};
    draw.target = context.image(color);
    draw.width = frame.view().width;
    draw.height = frame.view().height;
    record_fullscreen(context.commands(), draw);
  });
  return {};
}

}  // namespace gloam
