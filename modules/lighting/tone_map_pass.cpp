// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/resources.h"
#include "modules/lighting/passes.h"
#include "shaders/lighting/lighting_shared.h"
#include "shaders/lighting/shaders.h"

namespace gloam {
namespace {

/// Fills an exposure slot from the frame's light.
Status add_meter_pass(FrameBuilder& frame, BufferRef& slots, std::uint32_t slot) {
  auto pipeline =
      frame.services().pipelines.get(gpu::ComputePipelineDesc{"meter", "lighting", shaders::lighting::meter_comp, {}});
  if (!pipeline.ok()) return pipeline.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  const ImageRef lit = frame.get<LitOutput>().color;
  PassBuilder pass = frame.graph().add_pass("meter", "lighting");
  pass.read(lit, gpu::Access::compute_read);
  slots = pass.write(slots, gpu::Access::compute_write);
  const shaders::MeterConstants constants{{frame.view().width, frame.view().height}, slot};
  pass.execute([lit, slots, constants, pipeline = *pipeline, sampler = *sampler](PassContext& context) {
    gpu::CommandList& commands = context.commands();
    commands.bind_pipeline(pipeline);
    const gpu::Binding bindings[] = {{0, gpu::Binding::Sampled{{.image = context.image(lit)}, sampler}},
                                     {1, gpu::Binding::BufferRange{context.buffer(slots)}}};
    commands.bind(bindings);
    commands.push(constants);
    commands.dispatch(1, 1, 1);
  });
  return {};
}

}  // namespace

Status add_tone_map_passes(FrameBuilder& frame, ExposureSlots& exposures) {
  const FrameServices& services = frame.services();
  GLOAM_TRY(exposures.prepare(services.device));
  const auto& environment = frame.world().resource<SceneEnvironment>();
  BufferRef& slots = exposures.in(frame.graph());
  TargetOutput& target = frame.get<TargetOutput>();

  shaders::ToneMapConstants constants{};
  constants.curve = frame.knobs().choice("lighting.tone_map");
  constants.encode_srgb = gpu::encodes_srgb(target.format) ? 0 : 1;
  if (environment.has_exposure) {
    constants.exposure = exposure_from_ev100(environment.exposure_ev100);
  } else {
    const ExposureSlots::Slot slot = exposures.slot_of(frame.world().resource<LightingWorld>(), frame.view());
    constants.exposure_slot = slot.index;
    constants.metered = 1;
    if (slot.fresh) GLOAM_TRY(add_meter_pass(frame, slots, slot.index));
  }

  auto pipeline = services.pipelines.get(fullscreen_pipeline("tone_map/" + std::string(gpu::name_of(target.format)), "lighting",
                                                             shaders::lighting::tone_map_frag, target.format));
  if (!pipeline.ok()) return pipeline.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  const ImageRef lit = frame.get<LitOutput>().color;
  PassBuilder pass = frame.graph().add_pass("tone_map", "lighting");
  pass.read(lit, gpu::Access::fragment_read);
  pass.read(slots, gpu::Access::fragment_read);
  target.color = pass.write(target.color, gpu::Access::color_target);
  pass.execute([&frame, lit, slots, constants, color = target.color, pipeline = *pipeline, sampler = *sampler](PassContext& context) {
    gpu::CommandList& commands = context.commands();
    gpu::RenderingDesc rendering;
    rendering.colors.push_back({.view = {.image = context.image(color)}, .load = gpu::LoadOp::discard});
    rendering.width = frame.view().width;
    rendering.height = frame.view().height;
    commands.begin_rendering(rendering);
    commands.set_viewport(0.0f, 0.0f, static_cast<float>(rendering.width), static_cast<float>(rendering.height));
    commands.set_scissor(0, 0, rendering.width, rendering.height);
    commands.bind_pipeline(pipeline);
    const gpu::Binding bindings[] = {{0, gpu::Binding::Sampled{{.image = context.image(lit)}, sampler}},
                                     {1, gpu::Binding::BufferRange{context.buffer(slots)}}};
    commands.bind(bindings);
    commands.push(constants);
    commands.draw(3, 1, 0, 0);
    commands.end_rendering();
  });
  return {};
}

}  // namespace gloam
