// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/environment.h"
#include "modules/lighting/passes.h"
#include "shaders/lighting/shaders.h"

namespace gloam {
namespace {

const SurfacePass& forward_surface_pass() {
  static const SurfacePass pass = [] {
    SurfacePass p;
    p.name = "forward";
    p.module = "lighting";
    p.fragment = shaders::lighting::forward_frag;
    p.color_formats = {gpu::Format::rgba16_float};
    p.blend = gpu::BlendMode::alpha;
    p.depth_write = false;
    return p;
  }();
  return pass;
}

}  // namespace

Status add_forward_pass(FrameBuilder& frame) {
  if (frame.draws().blended.empty()) return {};
  auto inputs = shading_inputs(frame);
  if (!inputs.ok()) return inputs.error();
  GLOAM_TRY(frame.prepare_surfaces(frame.draws().blended, forward_surface_pass()));
  const GeometryOutputs geometry = frame.get<GeometryOutputs>();
  LitOutput& lit = frame.get<LitOutput>();
  PassBuilder pass = frame.graph().add_pass("forward", "lighting");
  pass.read(geometry.depth, gpu::Access::depth_test);
  frame.read_vertices(pass);
  lit.color = pass.write(lit.color, gpu::Access::color_target);
  pass.execute([&frame, geometry, inputs = *inputs, color = lit.color](PassContext& context) {
    gpu::RenderingDesc rendering;
    rendering.colors.push_back({.view = {.image = context.image(color)}, .load = gpu::LoadOp::load});
    rendering.depth = {.view = {.image = context.image(geometry.depth)}, .load = gpu::LoadOp::load, .read_only = true};
    rendering.width = frame.view().width;
    rendering.height = frame.view().height;
    gpu::CommandList& commands = context.commands();
    commands.begin_rendering(rendering);
    commands.set_viewport(0.0f, 0.0f, static_cast<float>(rendering.width), static_cast<float>(rendering.height));
    commands.set_scissor(0, 0, rendering.width, rendering.height);
    const gpu::Binding bindings[] = {frame.view_binding(), {1, inputs.lights}, {2, inputs.environment}};
    // Pipelines were made in declaration: nothing is left to fail.
    static_cast<void>(frame.draw_surfaces(context, frame.draws().blended, forward_surface_pass(), bindings));
    commands.end_rendering();
  });
  return {};
}

}  // namespace gloam
