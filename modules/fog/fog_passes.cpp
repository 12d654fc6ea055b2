// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/fog/fog_passes.h"

#include "modules/fog/fog_model.h"
#include "shaders/fog/fog_shared.h"
#include "shaders/fog/shaders.h"

namespace gloam {
namespace {

constexpr gpu::Format kGlowFormat = gpu::Format::rgba16_float;

/// A full-screen pass from one image to another. `constants` are pushed unless empty.
struct FilterPass {
  std::string name;
  gpu::PipelineHandle pipeline;
  gpu::SamplerHandle sampler;
  std::vector<std::byte> constants;
};

ImageRef add_filter_pass(FrameBuilder& frame, FilterPass filter, ImageRef source, ImageRef target) {
  FrameGraph& graph = frame.graph();
  PassBuilder pass = graph.add_pass(filter.name, "fog");
  pass.read(source, gpu::Access::fragment_read);
  target = pass.write(target, gpu::Access::color_target);
  pass.execute([&graph, filter = std::move(filter), source, target](PassContext& context) {
    FullscreenPass draw;
    draw.pipeline = filter.pipeline;
    draw.bindings = {{0, gpu::Binding::Sampled{{.image = context.image(source)}, filter.sampler}}};
    draw.target = context.image(target);
    draw.width = graph.desc(target).width;
    draw.height = graph.desc(target).height;
    draw.constants = filter.constants;
    record_fullscreen(context.commands(), draw);
  });
  return target;
}

std::vector<std::byte> bytes_of(const shaders::FogBlurConstants& constants) {
  const auto bytes = std::as_bytes(std::span(&constants, 1));
  return {bytes.begin(), bytes.end()};
}

std::uint32_t glow_divisor(const KnobRegistry& knobs) { return 1u << knobs.choice("fog.resolution"); }

gpu::GraphicsPipelineDesc blur_pipeline() {
  return fullscreen_pipeline("fog_blur", "fog", shaders::fog::blur_frag, kGlowFormat);
}

gpu::GraphicsPipelineDesc reduce_pipeline(std::uint32_t divisor) {
  gpu::GraphicsPipelineDesc desc =
      fullscreen_pipeline("fog_reduce/" + std::to_string(divisor), "fog", shaders::fog::reduce_frag, kGlowFormat);
  desc.constants = {{0, divisor}};
  return desc;
}

gpu::GraphicsPipelineDesc apply_pipeline(bool orthographic) {
  gpu::GraphicsPipelineDesc desc =
      fullscreen_pipeline(orthographic ? "fog_apply/orthographic" : "fog_apply/perspective", "fog",
                          shaders::fog::apply_frag, gpu::Format::rgba16_float);
  desc.constants = {{0, orthographic ? 1u : 0u}};
  desc.blend = gpu::BlendMode::premultiplied;
  return desc;
}

/// LitOutput blurred at 1/divisor of its size.
[[nodiscard]] Result<ImageRef> add_glow_passes(FrameBuilder& frame, std::uint32_t divisor, float radius) {
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  auto blur = frame.services().pipelines.get(blur_pipeline());
  if (!blur.ok()) return blur.error();
  ImageRef source = frame.get<LitOutput>().color;
  if (divisor > 1) {
    auto reduce = frame.services().pipelines.get(reduce_pipeline(divisor));
    if (!reduce.ok()) return reduce.error();
    const ImageRef reduced = create_view_image(frame, "fog_reduced", "fog", kGlowFormat, divisor);
    source = add_filter_pass(frame, {"fog_reduce", *reduce, *sampler, {}}, source, reduced);
  }
  const GlowKernel kernel = glow_kernel(frame.view().height, divisor, radius);
  const auto blur_pass = [&](const char* name, glm::ivec2 direction, ImageRef from) {
    const ImageRef target = create_view_image(frame, name, "fog", kGlowFormat, divisor);
    return add_filter_pass(frame, {name, *blur, *sampler, bytes_of({direction, kernel.taps, 1.0f / kernel.sigma})},
                           from, target);
  };
  return blur_pass("fog_blur_y", {0, 1}, blur_pass("fog_blur_x", {1, 0}, source));
}

}  // namespace

void list_fog_pipelines(const KnobRegistry& knobs, PipelineList& list) {
  if (glow_divisor(knobs) > 1) list.push_back(reduce_pipeline(glow_divisor(knobs)));
  list.push_back(blur_pipeline());
  list.push_back(apply_pipeline(false));
}

Status add_fog_passes(FrameBuilder& frame, const Fog& fog) {
  const FrameServices& services = frame.services();
  auto glow =
      add_glow_passes(frame, glow_divisor(frame.knobs()), static_cast<float>(frame.knobs().number("fog.radius")));
  if (!glow.ok()) return glow.error();

  const shaders::FogConstants constants{vec4(fog.color, 0.0f), fog.density, kFogForwardShare, kFogSkyDistance};
  auto range = services.uniforms.write_value(constants);
  if (!range.ok()) return range.error();
  auto pipeline = services.pipelines.get(apply_pipeline(frame.view().camera.orthographic));
  if (!pipeline.ok()) return pipeline.error();
  auto nearest = frame.nearest_sampler();
  if (!nearest.ok()) return nearest.error();
  auto linear = frame.linear_sampler();
  if (!linear.ok()) return linear.error();

  const ImageRef depth = frame.get<GeometryOutputs>().depth;
  LitOutput& lit = frame.get<LitOutput>();
  PassBuilder pass = frame.graph().add_pass("fog_apply", "fog");
  pass.read(depth, gpu::Access::fragment_read);
  pass.read(*glow, gpu::Access::fragment_read);
  lit.color = pass.write(lit.color, gpu::Access::color_target);
  pass.execute([&frame, depth, glow = *glow, color = lit.color, range = *range, pipeline = *pipeline,
                nearest = *nearest, linear = *linear](PassContext& context) {
    FullscreenPass draw;
    draw.pipeline = pipeline;
    draw.bindings = {frame.view_binding(),
                     {1, range},
                     {2, gpu::Binding::Sampled{{.image = context.image(depth)}, nearest}},
                     {3, gpu::Binding::Sampled{{.image = context.image(glow)}, linear}}};
    draw.target = context.image(color);
    draw.width = frame.view().width;
    draw.height = frame.view().height;
    draw.load = gpu::LoadOp::load;  // the fog is blended over the light
    record_fullscreen(context.commands(), draw);
  });
  return {};
}

}  // namespace gloam
