// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/draw_pass.h"
#include "modules/lighting/environment.h"
#include "modules/lighting/passes.h"
#include "modules/shadows/outputs.h"
#include "shaders/lighting/shaders.h"

namespace gloam {
namespace {

/// `shadows`: null for shading without shadows and cookies.
gpu::ShaderCode shading_code(bool tiled, const ShadowsOutputs* shadows) {
  using namespace shaders::lighting;
  if (shadows == nullptr) return tiled ? forward_tiled_frag : forward_frag;
  if (shadows->cookies_only) return tiled ? forward_tiled_cookies_frag : forward_cookies_frag;
  if (shadows->standard) return tiled ? forward_tiled_shadowed_standard_frag : forward_shadowed_standard_frag;
  return tiled ? forward_tiled_shadowed_frag : forward_shadowed_frag;
}

SurfacePass forward_surface_pass(bool tiled, const ShadowsOutputs* shadows) {
  SurfacePass pass;
  pass.module = "lighting";
  pass.fragment = shading_code(tiled, shadows);
  pass.color_formats = {gpu::Format::rgba16_float};
  pass.blend = gpu::BlendMode::alpha;
  pass.depth_write = false;
  if (shadows != nullptr) pass.constants = shadows->constants;
  return pass;
}

struct Variant {
  bool tiled = false;
  const ShadowsOutputs* shadows = nullptr;  ///< on the frame's board
  SurfacePass surfaces;
};

/// Chooses the best variant whose pipelines are ready. While tiled pipelines are built, the pass loops over all lights,
/// which gives the same picture. While shadowed pipelines are built, the picture has no shadows.
Variant choose_variant(FrameBuilder& frame, const ShadingInputs& inputs) {
  Variant f;
  const std::span<const Draw> draws = frame.draws().blended;
  const auto choose = [&](bool tiled, const ShadowsOutputs* shadows) {
    f.tiled = tiled;
    f.shadows = shadows;
    f.surfaces = forward_surface_pass(tiled, shadows);
  };
  const bool has_lists = inputs.outputs.has_lists();
  const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>();
  choose(has_lists, shadows);
  if (frame.services().wait_for_pipelines) return f;
  if (shadows != nullptr) {
    if (frame.request_surfaces(draws, f.surfaces)) return f;
    choose(false, shadows);
    if (has_lists && frame.has_surfaces(draws, f.surfaces)) return f;
  }
  choose(has_lists, nullptr);
  if (has_lists && !frame.request_surfaces(draws, f.surfaces)) choose(false, nullptr);
  return f;
}

}  // namespace

void add_forward_pass(FrameBuilder& frame) {
  if (frame.draws().blended.empty()) return;
  const ShadingInputs& inputs = shading_inputs(frame);
  const Variant variant = choose_variant(frame, inputs);
  LitOutput& lit = frame.get<LitOutput>();
  DrawPass pass(frame, "forward");
  lit.color = pass.target(lit.color, gpu::LoadOp::load);
  pass.test_depth(frame.get<GeometryOutputs>().depth);
  pass.use(variant.surfaces);
  pass.read("environment", inputs.environment);
  read_light_lists(pass, inputs.outputs);
  if (variant.shadows != nullptr) read_shadows(pass, *variant.shadows);
  pass.surfaces(frame.draws().blended);
}

}  // namespace gloam
