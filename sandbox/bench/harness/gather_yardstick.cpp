// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/harness/gather_yardstick.h"

#include <cstring>
#include <vector>

#include "engine/core/hash.h"
#include "engine/frame/transfers/upload.h"
#include "engine/render/declare/draw_pass.h"
#include "engine/render/readback/capture.h"
#include "shaders/sandbox/shaders.h"

namespace gloam {
namespace {

constexpr std::uint32_t kMapSize = 1024;

/// Pseudo-random depths in 0…1, the same on every platform.
std::vector<std::byte> map_texels() {
  std::vector<float> texels(std::size_t{kMapSize} * kMapSize);
  std::uint32_t state = 1;
  for (float& texel : texels) {
    state = state * 1664525u + 1013904223u;
    texel = static_cast<float>(state >> 8) / 16777216.0f;
  }
  std::vector<std::byte> bytes(texels.size() * sizeof(float));
  std::memcpy(bytes.data(), texels.data(), bytes.size());
  return bytes;
}

}  // namespace

Result<std::unique_ptr<GatherYardstick>> GatherYardstick::create(gpu::Device& device, std::uint32_t width,
                                                                 std::uint32_t height) {
  std::unique_ptr<GatherYardstick> yardstick(new GatherYardstick(device));
  GLOAM_TRY(yardstick->prepare(width, height));
  return yardstick;
}

GatherYardstick::~GatherYardstick() {
  static_cast<void>(device_.wait_idle());
  if (map_) device_.destroy(map_);
  if (target_) device_.destroy(target_);
  if (pipeline_) device_.destroy(pipeline_);
}

Status GatherYardstick::prepare(std::uint32_t width, std::uint32_t height) {
  gpu::ImageDesc map;
  map.name = "yardstick_map";
  map.module = "engine";
  map.format = gpu::Format::d32_float;
  map.width = map.height = kMapSize;
  map.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_target;
  auto made_map = device_.create_image(map);
  if (!made_map.ok()) return made_map.error();
  map_ = *made_map;
  gpu::ImageDesc target = map;
  target.name = "yardstick_target";
  target.format = gpu::Format::r32_float;
  target.width = width;
  target.height = height;
  target.usage = gpu::ImageUsage::color_target | gpu::ImageUsage::transfer_source;
  auto made_target = device_.create_image(target);
  if (!made_target.ok()) return made_target.error();
  target_ = *made_target;
  gpu::SamplerDesc nearest;
  nearest.min_filter = nearest.mag_filter = nearest.mip_filter = gpu::Filter::nearest;
  nearest.address_u = nearest.address_v = gpu::AddressMode::clamp_to_edge;
  auto sampler = device_.create_sampler(nearest);
  if (!sampler.ok()) return sampler.error();
  sampler_ = *sampler;
  const gpu::Format colors[] = {target.format};
  auto pipeline = device_.create_pipeline(pipeline_desc({shaders::sandbox::gather48_frag}, "engine", colors));
  if (!pipeline.ok()) return pipeline.error();
  pipeline_ = *pipeline;
  Uploader uploader(device_);
  uploader.image(map_, map_texels(), gpu::Access::fragment_read);
  return uploader.flush();
}

Status GatherYardstick::draw() {
  auto commands = device_.begin_frame();
  if (!commands.ok()) return commands.error();
  graph_.begin();
  ImageRef target = graph_.import_image("yardstick_target", target_, gpu::Access::none, gpu::Access::transfer_read);
  const gpu::ImageDesc desc = device_.desc(target_);
  PassBuilder pass = graph_.add_pass("gather48", "engine");
  target = pass.write(target, gpu::Access::color_target);
  pass.execute([&](PassContext& context) {
    gpu::CommandList& list = context.commands();
    list.begin_rendering({.colors = {{.view = {.image = context.image(target)}, .load = gpu::LoadOp::discard}},
                          .width = desc.width,
                          .height = desc.height});
    list.set_viewport(0.0f, 0.0f, static_cast<float>(desc.width), static_cast<float>(desc.height));
    list.set_scissor(0, 0, desc.width, desc.height);
    const gpu::Binding map[] = {{0, gpu::Binding::Sampled{{.image = map_}, sampler_}}};
    list.bind_pipeline(pipeline_);
    list.bind(map);
    list.draw(3, 1, 0, 0);
    list.end_rendering();
  });
  GLOAM_TRY(graph_.compile());
  graph_.execute(**commands);
  GLOAM_TRY(device_.submit_frame());
  return device_.wait_idle();
}

Result<std::uint64_t> GatherYardstick::picture_hash() {
  auto bytes = read_image_now(device_, target_);
  if (!bytes.ok()) return bytes.error();
  return hash_bytes(*bytes);
}

}  // namespace gloam
