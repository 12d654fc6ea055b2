// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <utility>

#include "modules/lighting/environment.h"
#include "modules/lighting/passes.h"
#include "modules/shadows/outputs.h"
#include "shaders/lighting/shaders.h"

namespace gloam {
namespace {

/// First binding of shadows or cookies: GLOAM_SHADOWS_BINDING or GLOAM_COOKIES_BINDING in the shaders.
constexpr std::uint32_t kFirstShadowBinding = 7;

SurfacePass make_surface_pass(std::string name, gpu::ShaderCode fragment) {
  SurfacePass p;
  p.name = std::move(name);
  p.module = "lighting";
  p.fragment = fragment;
  p.color_formats = {gpu::Format::rgba16_float};
  p.blend = gpu::BlendMode::alpha;
  p.depth_write = false;
  return p;
}

/// `shadows`: null for shading without shadows and cookies.
gpu::ShaderCode shading_code(bool tiled, const ShadowsOutputs* shadows) {
  using namespace shaders::lighting;
  if (shadows == nullptr) return tiled ? forward_tiled_frag : forward_frag;
  if (shadows->cookies_only) return tiled ? forward_tiled_cookies_frag : forward_cookies_frag;
  if (shadows->standard) return tiled ? forward_tiled_shadowed_standard_frag : forward_shadowed_standard_frag;
  return tiled ? forward_tiled_shadowed_frag : forward_shadowed_frag;
}

SurfacePass forward_surface_pass(bool tiled, const ShadowsOutputs* shadows) {
  const std::string variant = shadows == nullptr ? "" : "/" + shadows->variant;
  SurfacePass pass = make_surface_pass((tiled ? "forward_tiled" : "forward") + variant, shading_code(tiled, shadows));
  if (shadows != nullptr) pass.constants = shadows->constants;
  return pass;
}

/// Inputs for drawing the pass.
struct Forward {
  ShadingInputs inputs;
  const ShadowsOutputs* shadows = nullptr;  ///< on the frame's board
  bool tiled = false;
  SurfacePass surfaces;
  GeometryOutputs geometry;
  ImageRef color;
  gpu::SamplerHandle sampler;
};

/// Chooses the best variant whose pipelines are ready. While tiled pipelines are built, the pass loops over all lights,
/// which gives the same picture. While shadowed pipelines are built, the picture has no shadows.
void choose_variant(FrameBuilder& frame, Forward& f) {
  const std::span<const Draw> draws = frame.draws().blended;
  const auto choose = [&](bool tiled, const ShadowsOutputs* shadows) {
    f.tiled = tiled;
    f.shadows = shadows;
    f.surfaces = forward_surface_pass(tiled, shadows);
  };
  const bool has_lists = f.inputs.outputs.has_lists();
  const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>();
  choose(has_lists, shadows);
  if (frame.services().wait_for_pipelines) return;
  if (shadows != nullptr) {
    if (frame.request_surfaces(draws, f.surfaces)) return;
    choose(false, shadows);
    if (has_lists && frame.has_surfaces(draws, f.surfaces)) return;
  }
  choose(has_lists, nullptr);
  if (has_lists && !frame.request_surfaces(draws, f.surfaces)) choose(false, nullptr);
}

std::vector<gpu::Binding> bindings_of(const FrameBuilder& frame, const PassContext& context, const Forward& f) {
  std::vector<gpu::Binding> bindings = {frame.view_binding(), {1, f.inputs.lights}, {2, f.inputs.environment}};
  const LightsOutputs& lights = f.inputs.outputs;
  if (f.tiled) {
    bindings.push_back({3, lights.grid});
    bindings.push_back({4, gpu::Binding::Sampled{{.image = context.image(lights.texels)}, f.sampler}});
    bindings.push_back({5, lights.z_bins});
    bindings.push_back({6, lights.mask_tiles});
  }
  if (f.shadows != nullptr) append_arriving_bindings(bindings, kFirstShadowBinding, context, *f.shadows);
  return bindings;
}

}  // namespace

Status add_forward_pass(FrameBuilder& frame) {
  if (frame.draws().blended.empty()) return {};
  auto inputs = shading_inputs(frame);
  if (!inputs.ok()) return inputs.error();
  Forward f;
  f.inputs = *inputs;
  choose_variant(frame, f);
  GLOAM_TRY(frame.prepare_surfaces(frame.draws().blended, f.surfaces));
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  f.sampler = *sampler;
  f.geometry = frame.get<GeometryOutputs>();
  LitOutput& lit = frame.get<LitOutput>();
  PassBuilder pass = frame.graph().add_pass("forward", "lighting");
  pass.read(f.geometry.depth, gpu::Access::depth_test);
  if (f.tiled) pass.read(f.inputs.outputs.texels, gpu::Access::fragment_read);
  if (f.shadows != nullptr) declare_arriving_reads(pass, *f.shadows, gpu::Access::fragment_read);
  frame.read_vertices(pass);
  f.color = lit.color = pass.write(lit.color, gpu::Access::color_target);
  pass.execute([&frame, f = std::move(f)](PassContext& context) {
    gpu::RenderingDesc rendering;
    rendering.colors.push_back({.view = {.image = context.image(f.color)}, .load = gpu::LoadOp::load});
    rendering.depth = {
        .view = {.image = context.image(f.geometry.depth)}, .load = gpu::LoadOp::load, .read_only = true};
    gpu::CommandList& commands = context.commands();
    begin_view_rendering(commands, frame.view(), std::move(rendering));
    const Status drawn =
        frame.draw_surfaces(context, frame.draws().blended, f.surfaces, bindings_of(frame, context, f));
    if (!drawn.ok()) context.fail(drawn.error());
    commands.end_rendering();
  });
  return {};
}

}  // namespace gloam
