// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/resources.h"
#include "modules/lighting/exposure.h"
#include "modules/lighting/passes.h"
#include "shaders/lighting/lighting_shared.h"
#include "shaders/lighting/shaders.h"

namespace gloam {
namespace {

/// The metered exposure of the view's camera. It stays for as long as frames show the camera: History destroys it
/// later.
Result<HistoryBuffer> exposure_of(FrameBuilder& frame) {
  gpu::BufferDesc desc;
  desc.name = "exposure";
  desc.module = "lighting";
  desc.size = sizeof(float);
  desc.usage = gpu::BufferUsage::storage;
  const Entity camera = frame.view().camera_entity;
  return frame.history_buffer(desc, {.scope = HistoryScope::view,
                                     .rest = gpu::Access::fragment_read,
                                     .instance = std::uint64_t{camera.generation} << 32 | camera.index});
}

/// Meters the frame's light into an exposure.
Status add_meter_pass(FrameBuilder& frame, BufferRef& exposure) {
  auto pipeline =
      frame.services().pipelines.get(gpu::ComputePipelineDesc{"meter", "lighting", shaders::lighting::meter_comp, {}});
  if (!pipeline.ok()) return pipeline.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  const ImageRef lit = frame.get<LitOutput>().color;
  PassBuilder pass = frame.graph().add_pass("meter", "lighting");
  pass.read(lit, gpu::Access::compute_read);
  exposure = pass.write(exposure, gpu::Access::compute_write);
  const shaders::MeterConstants constants{{frame.view().width, frame.view().height}};
  pass.execute([lit, exposure, constants, pipeline = *pipeline, sampler = *sampler](PassContext& context) {
    gpu::CommandList& commands = context.commands();
    commands.bind_pipeline(pipeline);
    const gpu::Binding bindings[] = {{0, gpu::Binding::Sampled{{.image = context.image(lit)}, sampler}},
                                     {1, gpu::Binding::BufferRange{context.buffer(exposure)}}};
    commands.bind(bindings);
    commands.push(constants);
    commands.dispatch(1, 1, 1);
  });
  return {};
}

/// The chosen tone curve as a table; none if lighting.tone_map_table = exact.
Result<ImageRef> add_tone_table_pass(FrameBuilder& frame) {
  static constexpr std::uint32_t kSizes[] = {0, 1024, 256, 64};  // indexed by the choice of lighting.tone_map_table
  const std::uint32_t size = kSizes[frame.knobs().choice("lighting.tone_map_table")];
  if (size == 0) return ImageRef{};
  auto pipeline = frame.services().pipelines.get(
      gpu::ComputePipelineDesc{"tone_table", "lighting", shaders::lighting::tone_table_comp, {}});
  if (!pipeline.ok()) return pipeline.error();
  gpu::ImageDesc desc;
  desc.name = "tone_table";
  desc.module = "lighting";
  desc.format = gpu::Format::rgba16_float;
  desc.width = size;
  PassBuilder pass = frame.graph().add_pass("tone_table", "lighting");
  const ImageRef table = pass.write(frame.graph().create_image(desc), gpu::Access::compute_write);
  const shaders::ToneTableConstants constants{frame.knobs().choice("lighting.tone_map"), size};
  pass.execute([table, constants, pipeline = *pipeline](PassContext& context) {
    gpu::CommandList& commands = context.commands();
    commands.bind_pipeline(pipeline);
    const gpu::Binding bindings[] = {{0, gpu::Binding::Storage{{.image = context.image(table)}}}};
    commands.bind(bindings);
    commands.push(constants);
    commands.dispatch((constants.size + 63) / 64, 1, 1);
  });
  return table;
}

struct ToneMapPass {
  shaders::ToneMapConstants constants{};
  gpu::PipelineHandle pipeline;
  gpu::SamplerHandle nearest;
  gpu::SamplerHandle linear;
  ImageRef table;  ///< none: the curve is computed per pixel
};

void add_tone_map_pass(FrameBuilder& frame, const ToneMapPass& tone_map, BufferRef exposure) {
  const ImageRef lit = frame.get<LitOutput>().color;
  TargetOutput& target = frame.get<TargetOutput>();
  PassBuilder pass = frame.graph().add_pass("tone_map", "lighting");
  pass.read(lit, gpu::Access::fragment_read);
  pass.read(exposure, gpu::Access::fragment_read);
  if (tone_map.table) pass.read(tone_map.table, gpu::Access::fragment_read);
  target.color = pass.write(target.color, gpu::Access::color_target);
  pass.execute([&frame, lit, exposure, tone_map, color = target.color](PassContext& context) {
    // Without a table the shader does not read this image, but every binding must be set.
    const ImageRef table = tone_map.table ? tone_map.table : lit;
    FullscreenPass draw;
    draw.pipeline = tone_map.pipeline;
    draw.bindings = {{0, gpu::Binding::Sampled{{.image = context.image(lit)}, tone_map.nearest}},
                     {1, gpu::Binding::BufferRange{context.buffer(exposure)}},
                     {2, gpu::Binding::Sampled{{.image = context.image(table)}, tone_map.linear}}};
    draw.target = context.image(color);
    draw.width = frame.view().width;
    draw.height = frame.view().height;
    draw.constants = std::as_bytes(std::span(&tone_map.constants, 1));
    record_fullscreen(context.commands(), draw);
  });
}

}  // namespace

Status add_tone_map_passes(FrameBuilder& frame) {
  const FrameServices& services = frame.services();
  const auto& environment = frame.world().resource<SceneEnvironment>();
  auto metered = exposure_of(frame);  // bound even if the exposure is set
  if (!metered.ok()) return metered.error();
  const TargetOutput& target = frame.get<TargetOutput>();

  ToneMapPass tone_map;
  shaders::ToneMapConstants& constants = tone_map.constants;
  constants.curve = frame.knobs().choice("lighting.tone_map");
  constants.encode_srgb = gpu::encodes_srgb(target.format) ? 0 : 1;
  if (environment.has_exposure) {
    constants.exposure = exposure_from_ev100(environment.exposure_ev100);
  } else {
    constants.metered = 1;
    if (!metered->filled()) GLOAM_TRY(add_meter_pass(frame, metered->buffer));
  }

  auto table = add_tone_table_pass(frame);
  if (!table.ok()) return table.error();
  tone_map.table = *table;
  gpu::GraphicsPipelineDesc desc = fullscreen_pipeline(
      std::string(tone_map.table ? "tone_map_table/" : "tone_map/") + std::string(gpu::name_of(target.format)),
      "lighting", shaders::lighting::tone_map_frag, target.format);
  desc.constants = {{0, tone_map.table ? 1u : 0u}};
  auto pipeline = services.pipelines.get(desc);
  if (!pipeline.ok()) return pipeline.error();
  auto nearest = frame.nearest_sampler();
  if (!nearest.ok()) return nearest.error();
  auto linear = frame.linear_sampler();
  if (!linear.ok()) return linear.error();
  tone_map.pipeline = *pipeline;
  tone_map.nearest = *nearest;
  tone_map.linear = *linear;
  add_tone_map_pass(frame, tone_map, metered->buffer);
  return {};
}

}  // namespace gloam
