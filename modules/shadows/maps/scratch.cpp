// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/maps/scratch.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "engine/core/assert.h"
#include "engine/gpu/access.h"
#include "modules/shadows/maps/scratch_plan.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam {

Status ShadowScratch::reserve(gpu::Device& device, std::uint64_t texels) {
  if (texels <= texels_) return {};
  texels = std::bit_ceil(texels);
  std::vector<gpu::ImageDesc> descs;
  for (std::uint64_t size = GLOAM_SHADOW_SMALLEST_FACE; size * size <= texels; size *= 2) {
    gpu::ImageDesc desc;
    desc.name = "shadow_scratch";
    desc.module = "shadows";
    desc.format = gpu::Format::d32_float;
    desc.width = desc.height = static_cast<std::uint32_t>(size);
    desc.layers = static_cast<std::uint32_t>(std::min<std::uint64_t>(texels / (size * size), kMostScratchLayers));
    desc.shape = gpu::ImageShape::array;
    desc.usage = gpu::ImageUsage::depth_target | gpu::ImageUsage::sampled;
    descs.push_back(std::move(desc));
  }
  release(device);
  auto made = device.create_aliased_images(descs);
  if (!made.ok()) return made.error();
  images_ = std::move(*made);
  texels_ = texels;
  return {};
}

gpu::ImageHandle ShadowScratch::image(std::uint32_t size) const {
  const auto at = static_cast<std::size_t>(std::bit_width(size / GLOAM_SHADOW_SMALLEST_FACE)) - 1;
  GLOAM_ASSERT(at < images_.size(), "room for a face was reserved before it is drawn");
  return images_[at];
}

void ShadowScratch::release(gpu::Device& device) {
  for (const gpu::ImageHandle image : images_) device.destroy(image);
  images_.clear();
  texels_ = 0;
}

void ShadowScratch::begin_drawing(gpu::CommandList& commands, std::uint32_t size) const {
  gpu::ImageBarrier barrier{image(size), gpu::Access::none, gpu::Access::depth_target};
  barrier.also_before = gpu::mask_of(gpu::Access::depth_target) | gpu::mask_of(gpu::Access::compute_read);
  commands.barrier({}, std::span(&barrier, 1));
}

void ShadowScratch::begin_reading(gpu::CommandList& commands, std::uint32_t size) const {
  const gpu::ImageBarrier barrier{image(size), gpu::Access::depth_target, gpu::Access::compute_read};
  commands.barrier({}, std::span(&barrier, 1));
}

}  // namespace gloam
