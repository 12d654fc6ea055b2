// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/mip_chain_passes.h"

#include <algorithm>
#include <array>

#include "engine/core/assert.h"
#include "shaders/frame/shaders.h"

namespace gloam {

namespace {

using gpu::Access;

constexpr std::uint32_t kGroupSide = 8;  // local size of the kernel

gpu::ImageRange range_of_mip(std::uint32_t mip) { return {.first_mip = mip, .mip_count = 1}; }

ImageRef add_box_pass(FrameGraph& graph, const MipChain& chain, ImageRef larger, std::uint32_t mip) {
  const gpu::ImageDesc& desc = graph.desc(larger);
  const std::uint32_t groups_x = (std::max(desc.width >> mip, 1u) + kGroupSide - 1) / kGroupSide;
  const std::uint32_t groups_y = (std::max(desc.height >> mip, 1u) + kGroupSide - 1) / kGroupSide;
  const std::uint32_t layers = desc.layers;
  PassBuilder pass = graph.add_pass(chain.name, chain.module);
  pass.read(larger, Access::compute_read, range_of_mip(mip - 1));
  const ImageRef image = pass.write(larger, Access::compute_write, range_of_mip(mip));
  pass.execute([=, pipeline = chain.pipeline, sampler = chain.sampler](PassContext& context) {
    const gpu::ImageHandle handle = context.image(image);
    context.commands().bind_pipeline(pipeline);
    const std::array<gpu::Binding, 2> bindings = {
        {{0, gpu::Binding::Sampled{{.image = handle, .first_mip = mip - 1, .mip_count = 1}, sampler}},
         {1, gpu::Binding::Storage{{.image = handle, .first_mip = mip, .mip_count = 1}}}}};
    context.commands().bind(bindings);
    context.commands().dispatch(groups_x, groups_y, layers);
  });
  return image;
}

ImageRef add_blit_pass(FrameGraph& graph, const MipChain& chain, ImageRef larger, std::uint32_t mip) {
  const std::uint32_t layers = graph.desc(larger).layers;
  PassBuilder pass = graph.add_pass(chain.name, chain.module);
  pass.read(larger, Access::transfer_read, range_of_mip(mip - 1));
  const ImageRef image = pass.write(larger, Access::transfer_write, range_of_mip(mip));
  pass.execute([=](PassContext& context) {
    const gpu::ImageHandle handle = context.image(image);
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
      context.commands().blit(handle, handle, {mip - 1, layer}, {mip, layer});
    }
  });
  return image;
}

}  // namespace

std::optional<gpu::ShaderCode> mip_chain_shader(gpu::Format format) {
  switch (format) {
    case gpu::Format::rgba8_unorm:
      return shaders::frame::halve_rgba8_comp;
    case gpu::Format::rgba16_float:
      return shaders::frame::halve_rgba16f_comp;
    case gpu::Format::r32_float:
      return shaders::frame::halve_r32f_comp;
    case gpu::Format::r16_float:
      return shaders::frame::halve_r16f_comp;
    case gpu::Format::rg16_float:
      return shaders::frame::halve_rg16f_comp;
    case gpu::Format::rg11b10_float:
      return shaders::frame::halve_r11f_g11f_b10f_comp;
    default:
      return std::nullopt;
  }
}

bool supports_mip_chain(const gpu::Device& device, gpu::Format format, MipFilter filter) {
  if (filter == MipFilter::blit) return device.supports_blit(format);
  return mip_chain_shader(format).has_value() &&
         device.supports(format, gpu::ImageUsage::sampled | gpu::ImageUsage::storage);
}

ImageRef add_mip_chain(FrameGraph& graph, const MipChain& chain) {
  const gpu::ImageDesc desc = graph.desc(chain.image);
  GLOAM_ASSERT(desc.shape != gpu::ImageShape::volume,
               "a mip chain is of an image with layers, no volume: " + chain.name);
  GLOAM_ASSERT(chain.filter == MipFilter::blit || (chain.pipeline && chain.sampler),
               "a box filter needs its pipeline and a sampler: " + chain.name);
  ImageRef image = chain.image;
  for (std::uint32_t mip = 1; mip < desc.mips; ++mip) {
    image = chain.filter == MipFilter::box ? add_box_pass(graph, chain, image, mip)
                                           : add_blit_pass(graph, chain, image, mip);
  }
  return image;
}

}  // namespace gloam
