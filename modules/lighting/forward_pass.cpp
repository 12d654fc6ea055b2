// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/environment.h"
#include "modules/lighting/passes.h"
#include "shaders/lighting/shaders.h"

namespace gloam {
namespace {

SurfacePass make_surface_pass(const char* name, gpu::ShaderCode fragment) {
  SurfacePass p;
  p.name = name;
  p.module = "lighting";
  p.fragment = fragment;
  p.color_formats = {gpu::Format::rgba16_float};
  p.blend = gpu::BlendMode::alpha;
  p.depth_write = false;
  return p;
}

const SurfacePass& forward_surface_pass(bool tiled) {
  static const SurfacePass all_lights = make_surface_pass("forward", shaders::lighting::forward_frag);
  static const SurfacePass tile_lights = make_surface_pass("forward_tiled", shaders::lighting::forward_tiled_frag);
  return tiled ? tile_lights : all_lights;
}

std::vector<gpu::Binding> bindings_of(const FrameBuilder& frame, const PassContext& context,
                                      const ShadingInputs& inputs, bool tiled, gpu::SamplerHandle sampler) {
  std::vector<gpu::Binding> bindings = {frame.view_binding(), {1, inputs.lights}, {2, inputs.environment}};
  const LightsOutputs& lights = inputs.outputs;
  if (tiled) {
    bindings.push_back({3, lights.grid});
    bindings.push_back({4, gpu::Binding::Sampled{{.image = context.image(lights.texels)}, sampler}});
    bindings.push_back({5, lights.z_bins});
    bindings.push_back({6, lights.mask_tiles});
  }
  return bindings;
}

}  // namespace

Status add_forward_pass(FrameBuilder& frame) {
  if (frame.draws().blended.empty()) return {};
  auto inputs = shading_inputs(frame);
  if (!inputs.ok()) return inputs.error();
  bool tiled = inputs->outputs.has_lists();
  // All lights give the same picture while the tiled pipelines are made.
  if (tiled && !frame.services().wait_for_pipelines)
    tiled = frame.request_surfaces(frame.draws().blended, forward_surface_pass(true));
  GLOAM_TRY(frame.prepare_surfaces(frame.draws().blended, forward_surface_pass(tiled)));
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  const GeometryOutputs geometry = frame.get<GeometryOutputs>();
  LitOutput& lit = frame.get<LitOutput>();
  PassBuilder pass = frame.graph().add_pass("forward", "lighting");
  pass.read(geometry.depth, gpu::Access::depth_test);
  if (tiled) pass.read(inputs->outputs.texels, gpu::Access::fragment_read);
  frame.read_vertices(pass);
  lit.color = pass.write(lit.color, gpu::Access::color_target);
  pass.execute([&frame, geometry, tiled, inputs = *inputs, color = lit.color,
                sampler = *sampler](PassContext& context) {
    gpu::RenderingDesc rendering;
    rendering.colors.push_back({.view = {.image = context.image(color)}, .load = gpu::LoadOp::load});
    rendering.depth = {.view = {.image = context.image(geometry.depth)}, .load = gpu::LoadOp::load, .read_only = true};
    rendering.width = frame.view().width;
    rendering.height = frame.view().height;
    gpu::CommandList& commands = context.commands();
    commands.begin_rendering(rendering);
    commands.set_viewport(0.0f, 0.0f, static_cast<float>(rendering.width), static_cast<float>(rendering.height));
    commands.set_scissor(0, 0, rendering.width, rendering.height);
    // Pipelines were made in declaration: nothing is left to fail.
    static_cast<void>(frame.draw_surfaces(context, frame.draws().blended, forward_surface_pass(tiled),
                                          bindings_of(frame, context, inputs, tiled, sampler)));
    commands.end_rendering();
  });
  return {};
}

}  // namespace gloam
