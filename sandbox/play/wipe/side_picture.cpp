// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/wipe/side_picture.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "sandbox/session/drawing/enlarged.h"
#include "shaders/sandbox/shaders.h"

namespace gloam {
namespace {

constexpr const char* kWipeModule = "panel";

}  // namespace

/// The image of the next picture.
Result<gpu::ImageHandle> SidePicture::image(std::uint32_t width, std::uint32_t height) {
  gpu::ImageHandle& drawn = images_[1];
  if (drawn && device_.desc(drawn).width == width && device_.desc(drawn).height == height) return drawn;
  if (drawn) device_.destroy(std::exchange(drawn, {}));
  const auto made = device_.create_image({.name = "wipe_picture",
                                          .module = kWipeModule,
                                          .format = gpu::Format::rgba8_unorm,
                                          .width = width,
                                          .height = height,
                                          .usage = gpu::ImageUsage::color_target | gpu::ImageUsage::sampled});
  if (!made.ok()) return made.error();
  drawn = *made;
  return drawn;
}

Result<ViewRequest> SidePicture::request(const ViewSettings& settings, double scale) {
  const auto full = image(settings.width, settings.height);
  if (!full.ok()) return full.error();
  ViewRequest request = {.settings = settings, .target = {}, .keep_linear = false};
  request.settings.width = scaled_size(settings.width, scale);
  request.settings.height = scaled_size(settings.height, scale);
  request.target.after = gpu::Access::fragment_read;
  if (request.settings.width == settings.width && request.settings.height == settings.height) {
    request.target.image = *full;
    return request;
  }
  const auto reduced = upscaler_.image(request.settings.width, request.settings.height);
  if (!reduced.ok()) return reduced.error();
  request.settings.aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
  request.target.image = *reduced;
  request.target.overlay = [this, image = *full](FrameGraph& graph, ImageRef& picture) {
    ImageRef enlarged = graph.import_image("wipe_picture", image, gpu::Access::none, gpu::Access::fragment_read);
    return upscaler_.add_passes(graph, picture, enlarged);
  };
  return request;
}

void SidePicture::show_drawn() { std::swap(images_[0], images_[1]); }

bool SidePicture::fits(std::uint32_t width, std::uint32_t height) const {
  if (!images_[0]) return false;
  const gpu::ImageDesc& desc = device_.desc(images_[0]);
  return desc.width == width && desc.height == height;
}

Result<gpu::PipelineHandle> SidePicture::pipeline_for(gpu::Format format) {
  gpu::GraphicsPipelineDesc desc;
  desc.name = "wipe/" + std::string(gpu::name_of(format));
  desc.module = kWipeModule;
  desc.vertex = shaders::sandbox::upscale_vert;
  desc.fragment = shaders::sandbox::wipe_frag;
  desc.color_formats = {format};
  desc.cull = gpu::CullMode::none;
  desc.depth_compare = gpu::CompareOp::always;
  desc.depth_write = false;
  return pipelines_.get(desc);
}

Status SidePicture::add_pass(FrameGraph& graph, ImageRef& window, float at) {
  const gpu::ImageDesc target = graph.desc(window);
  if (!fits(target.width, target.height)) return {};
  const auto line =
      std::min(static_cast<std::uint32_t>(std::lround(at * static_cast<float>(target.width))), target.width);
  if (line == target.width) return {};
  const auto pipeline = pipeline_for(target.format);
  if (!pipeline.ok()) return pipeline.error();
  const auto sampler = device_.create_sampler({});
  if (!sampler.ok()) return sampler.error();
  const ImageRef exact =
      graph.import_image("shown_wipe_picture", images_[0], gpu::Access::fragment_read, gpu::Access::fragment_read);
  PassBuilder pass = graph.add_pass("wipe", kWipeModule);
  pass.read(exact, gpu::Access::fragment_read);
  window = pass.write(window, gpu::Access::color_target);
  pass.execute([exact, window, line, pipeline = *pipeline, sampler = *sampler, width = target.width,
                height = target.height](PassContext& context) {
    gpu::CommandList& commands = context.commands();
    commands.begin_rendering({.colors = {{.view = {.image = context.image(window)}, .load = gpu::LoadOp::load}},
                              .width = width,
                              .height = height});
    commands.bind_pipeline(pipeline);
    const gpu::Binding picture{0, gpu::Binding::Sampled{{.image = context.image(exact)}, sampler}};
    commands.bind({&picture, 1});
    commands.push(static_cast<float>(line));
    commands.set_scissor(static_cast<std::int32_t>(line), 0, width - line, height);
    commands.draw(3, 1, 0, 0);
    commands.end_rendering();
  });
  return {};
}

void SidePicture::release() {
  for (gpu::ImageHandle& image : images_)
    if (image) device_.destroy(std::exchange(image, {}));
  upscaler_.release();
}

}  // namespace gloam
