// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/passes/visualizer_pass.h"

#include <utility>

namespace gloam {

VisualizerTargets write_visualizer_targets(FrameBuilder& frame, PassBuilder& pass, std::string name, std::string module,
                                           gpu::Format format) {
  ImageRef& picture = frame.get<TargetOutput>().color;
  VisualizerTargets targets;
  targets.values = create_view_image(frame, std::move(name), std::move(module), format);
  targets.values = pass.write(targets.values, gpu::Access::color_target);
  targets.picture = picture = pass.write(picture, gpu::Access::color_target);
  return targets;
}

void begin_visualizer(PassContext& context, const RenderView& view, const VisualizerTargets& targets) {
  gpu::RenderingDesc rendering;
  rendering.colors.push_back({.view = {.image = context.image(targets.picture)}, .load = targets.load_picture});
  if (targets.values)
    rendering.colors.push_back({.view = {.image = context.image(targets.values)}, .load = gpu::LoadOp::clear});
  begin_view_rendering(context.commands(), view, std::move(rendering));
}

void record_visualizer(PassContext& context, const RenderView& view, const VisualizerTargets& targets,
                       gpu::PipelineHandle pipeline, std::span<const gpu::Binding> bindings,
                       std::span<const std::byte> constants) {
  begin_visualizer(context, view, targets);
  gpu::CommandList& commands = context.commands();
  commands.bind_pipeline(pipeline);
  commands.bind(bindings);
  if (!constants.empty()) commands.push_constants(constants);
  commands.draw(3, 1, 0, 0);
  commands.end_rendering();
}

}  // namespace gloam
