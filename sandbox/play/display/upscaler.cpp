// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/display/upscaler.h"

#include <array>
#include <string>

#include "shaders/sandbox/shaders.h"

namespace gloam {
namespace {

constexpr const char* kUpscaleModule = "panel";

}  // namespace

Result<gpu::ImageHandle> Upscaler::image(std::uint32_t width, std::uint32_t height) {
  if (image_ && device_.desc(image_).width == width && device_.desc(image_).height == height) return image_;
  release();
  const auto made = device_.create_image({.name = "reduced_picture",
                                          .module = kUpscaleModule,
                                          .format = gpu::Format::rgba8_unorm,
                                          .width = width,
                                          .height = height,
                                          .usage = gpu::ImageUsage::color_target | gpu::ImageUsage::sampled});
  if (!made.ok()) return made.error();
  image_ = *made;
  return image_;
}

void Upscaler::release() {
  if (image_) device_.destroy(image_);
  image_ = {};
}

Result<gpu::PipelineHandle> Upscaler::pipeline_for(gpu::Format format, bool vertical) {
  gpu::GraphicsPipelineDesc desc;
  desc.name = "upscale/" + std::string(gpu::name_of(format)) + (vertical ? "/vertical" : "/horizontal");
  desc.module = kUpscaleModule;
  desc.vertex = shaders::sandbox::upscale_vert;
  desc.fragment = shaders::sandbox::upscale_frag;
  desc.constants = {{"kVertical", vertical ? 1u : 0u}};
  desc.color_formats = {format};
  desc.cull = gpu::CullMode::none;
  desc.depth_compare = gpu::CompareOp::always;
  desc.depth_write = false;
  return pipelines_.get(desc);
}

Status Upscaler::add_pass(FrameGraph& graph, ImageRef from, ImageRef& to, bool vertical) {
  const gpu::ImageDesc source = graph.desc(from);
  const gpu::ImageDesc target = graph.desc(to);
  const auto pipeline = pipeline_for(target.format, vertical);
  if (!pipeline.ok()) return pipeline.error();
  const auto sampler = device_.create_sampler({});
  if (!sampler.ok()) return sampler.error();
  const std::array ratio = {vertical ? static_cast<float>(source.height) / static_cast<float>(target.height)
                                     : static_cast<float>(source.width) / static_cast<float>(target.width)};
  PassBuilder pass = graph.add_pass(vertical ? "upscale_y" : "upscale_x", kUpscaleModule);
  pass.read(from, gpu::Access::fragment_read);
  to = pass.write(to, gpu::Access::color_target);
  pass.execute([from, to, ratio, pipeline = *pipeline, sampler = *sampler, width = target.width,
                height = target.height](PassContext& context) {
    gpu::CommandList& commands = context.commands();
    commands.begin_rendering({.colors = {{.view = {.image = context.image(to)}, .load = gpu::LoadOp::discard}},
                              .width = width,
                              .height = height});
    commands.bind_pipeline(pipeline);
    const gpu::Binding picture{0, gpu::Binding::Sampled{{.image = context.image(from)}, sampler}};
    commands.bind({&picture, 1});
    commands.push(ratio);
    commands.draw(3, 1, 0, 0);
    commands.end_rendering();
  });
  return {};
}

Status Upscaler::add_passes(FrameGraph& graph, ImageRef picture, ImageRef& window) {
  ImageRef wide = graph.create_image({.name = "upscaled_x",
                                      .module = kUpscaleModule,
                                      .format = gpu::Format::rgba8_unorm,
                                      .width = graph.desc(window).width,
                                      .height = graph.desc(picture).height});
  GLOAM_TRY(add_pass(graph, picture, wide, false));
  return add_pass(graph, wide, window, true);
}

}  // namespace gloam
