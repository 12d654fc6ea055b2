// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/draw_pass.h"

#include "engine/core/assert.h"
#include "engine/render/camera/view_constants.h"
#include "engine/render/declare/recording.h"
#include "engine/render/scene/material_packing.h"
#include "shaders/render/shaders.h"

namespace gloam {
namespace {

using declare::Recording;
using declare::Step;
using declare::StepKind;

void begin_rendering(const FrameGraph& graph, const Recording& recording, PassContext& context) {
  gpu::RenderingDesc rendering;
  for (const declare::Target& target : recording.colors)
    rendering.colors.push_back({.view = {.image = context.image(target.image),
                                         .first_mip = target.mip,
                                         .mip_count = 1,
                                         .first_layer = target.layer,
                                         .layer_count = 1},
                                .load = target.load});
  if (recording.depth.image)
    rendering.depth = {.view = {.image = context.image(recording.depth.image)},
                       .load = recording.depth.load,
                       .read_only = recording.depth_read_only};
  const declare::Target& first = recording.colors.empty() ? recording.depth : recording.colors.front();
  const gpu::ImageDesc& image = graph.desc(first.image);
  const uvec2 area = glm::max(uvec2(image.width, image.height) >> first.mip, uvec2(1));
  rendering.width = area.x;
  rendering.height = area.y;
  gpu::CommandList& commands = context.commands();
  commands.begin_rendering(rendering);
  commands.set_viewport(0.0f, 0.0f, static_cast<float>(area.x), static_cast<float>(area.y));
  commands.set_scissor(0, 0, area.x, area.y);
}

void record_draws(FrameBuilder& frame, const Recording& recording, PassContext& context) {
  if (recording.failed) return;
  begin_rendering(frame.graph(), recording, context);
  gpu::CommandList& commands = context.commands();
  std::vector<gpu::Binding> storage;
  for (const Step& step : recording.steps) {
    switch (step.kind) {
      case StepKind::draw:
        begin_step(recording, step, context, storage);
        commands.draw(step.counts[0], step.counts[1], 0, 0);
        break;
      case StepKind::draw_indirect:
        begin_step(recording, step, context, storage);
        commands.draw_indirect(context.buffer(step.arguments), step.offset);
        break;
      case StepKind::draw_indexed_indirect:
        begin_step(recording, step, context, storage);
        commands.bind_indices(context.buffer(step.indices), 0);
        commands.draw_indexed_indirect(context.buffer(step.arguments), step.offset, step.counts[0]);
        break;
      case StepKind::surfaces:
        if (const Status drawn = frame.draw_surfaces(context, step.draws, recording.surface_passes[step.surface_pass],
                                                     bindings_of(recording, step, context, storage), step.arguments);
            !drawn.ok())
          context.fail(drawn.error());
        break;
      default:
        recording.functions[step.function](context);
        break;
    }
  }
  commands.end_rendering();
}

}  // namespace

gpu::GraphicsPipelineDesc pipeline_desc(const DrawProgram& program, std::string_view module,
                                        std::span<const gpu::Format> colors, gpu::Format depth) {
  gpu::GraphicsPipelineDesc desc;
  desc.module = module;
  desc.vertex = program.vertex.words.empty() ? shaders::render::fullscreen_vert : program.vertex;
  desc.fragment = program.fragment;
  desc.constants = program.constants;
  desc.color_formats.assign(colors.begin(), colors.end());
  desc.depth_format = depth;
  if (depth != gpu::Format::undefined) desc.depth_compare = program.depth_compare;
  desc.cull = program.cull;
  desc.blend = program.blend;
  desc.depth_write = program.depth_write && depth != gpu::Format::undefined;
  return desc;
}

DrawPass::DrawPass(FrameBuilder& frame, std::string_view name) : ShaderPass(frame, name) {
  graph_pass().execute(
      [&frame, recording = &recording()](PassContext& context) { record_draws(frame, *recording, context); });
}

ImageRef DrawPass::target(ImageRef image, gpu::LoadOp load, std::uint32_t mip, std::uint32_t layer) {
  image = graph_pass().write(image, gpu::Access::color_target, {mip, 1, layer, 1});
  recording().colors.push_back({image, load, mip, layer});
  return image;
}

ImageRef DrawPass::depth_target(ImageRef image, gpu::LoadOp load) {
  image = graph_pass().write(image, gpu::Access::depth_target);
  recording().depth = {image, load};
  return image;
}

void DrawPass::test_depth(ImageRef image) {
  graph_pass().read(image, gpu::Access::depth_test);
  recording().depth = {image, gpu::LoadOp::load};
  recording().depth_read_only = true;
}

void DrawPass::use(const DrawProgram& program) {
  program_ = program;
  forget_pipeline();
  const gpu::ShaderCode& vertex = program.vertex.words.empty() ? shaders::render::fullscreen_vert : program.vertex;
  auto interface = frame().services().declared.interfaces.of(vertex, program.fragment);
  if (!interface.ok()) return fail(interface.error());
  ShaderPass::use(*interface);
  check_constants(program.constants);
}

void DrawPass::use(const SurfacePass& surfaces) {
  recording().surface_passes.push_back(surfaces);
  auto interface = frame().services().declared.interfaces.of(surface_vertex_shader(surfaces), surfaces.fragment);
  if (!interface.ok()) return fail(interface.error());
  ShaderPass::use(*interface);
  check_constants(surfaces.constants);
}

bool DrawPass::choose_pipeline() {
  if (!has_program() || recording().failed) return false;
  if (has_pipeline()) return true;
  std::vector<gpu::Format> colors;
  for (const declare::Target& target : recording().colors) colors.push_back(frame().graph().desc(target.image).format);
  const ImageRef depth = recording().depth.image;
  GLOAM_ASSERT(depth || !colors.empty(), sentence("", "targets must be declared before the first draw"));
  GLOAM_ASSERT(!program_.depth_write || (depth && !recording().depth_read_only),
               sentence("", "a program that writes depth needs a depth target"));
  const gpu::Format depth_format = depth ? frame().graph().desc(depth).format : gpu::Format::undefined;
  use_pipeline(pipeline_desc(program_, frame().module(), colors, depth_format));
  return true;
}

void DrawPass::draw(std::uint32_t vertices, std::uint32_t instances) {
  if (!choose_pipeline()) return;
  Step& step = add_step(StepKind::draw);
  step.counts[0] = vertices;
  step.counts[1] = instances;
}

void DrawPass::draw_indirect(BufferRef arguments, std::uint64_t offset) {
  if (!choose_pipeline()) return;
  graph_pass().read(arguments, gpu::Access::indirect_read);
  Step& step = add_step(StepKind::draw_indirect);
  step.arguments = arguments;
  step.offset = offset;
}

void DrawPass::draw_indexed_indirect(BufferRef indices, BufferRef arguments, std::uint64_t offset,
                                     std::uint32_t draws) {
  if (!choose_pipeline()) return;
  graph_pass().read(indices, gpu::Access::vertex_input);
  graph_pass().read(arguments, gpu::Access::indirect_read);
  Step& step = add_step(StepKind::draw_indexed_indirect);
  step.indices = indices;
  step.arguments = arguments;
  step.offset = offset;
  step.counts[0] = draws;
}

void DrawPass::surfaces(std::span<const Draw> draws, BufferRef commands) {
  if (!has_program() || recording().failed) return;
  GLOAM_ASSERT(!recording().surface_passes.empty(), sentence("", "no surface pass was chosen"));
  if (const Status made = frame().prepare_surfaces(draws, recording().surface_passes.back()); !made.ok())
    return fail(made.error());
  frame().read_vertices(graph_pass(), recording().surface_passes.back().motion);
  if (commands) graph_pass().read(commands, gpu::Access::indirect_read);
  Step& step = add_step(StepKind::surfaces);
  step.draws = draws;
  step.arguments = commands;
  step.surface_pass = recording().surface_passes.size() - 1;
}

void geometry_targets(DrawPass& pass, GeometryOutputs& geometry) {
  for (ImageRef* image : {&geometry.base_color, &geometry.normals, &geometry.material, &geometry.emissive})
    *image = pass.target(*image, gpu::LoadOp::load);
  if (geometry.motion) geometry.motion = pass.target(geometry.motion, gpu::LoadOp::load);
  geometry.depth = pass.depth_target(geometry.depth, gpu::LoadOp::load);
}

std::span<const gpu::Format> geometry_formats(bool motion) { return geometry_surface_pass(motion).color_formats; }

void bind_motion(DrawPass& pass, const RenderView& view) {
  if (pass.declares("motion")) pass.uniform("motion", motion_constants(view));
}

}  // namespace gloam
