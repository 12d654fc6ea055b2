// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/resources/samplers.h"

#include <algorithm>

#include "engine/gpu/vulkan/convert.h"
#include "engine/gpu/vulkan/errors.h"

namespace gloam::gpu::vulkan {

Samplers::~Samplers() {
  for (const auto& [desc, sampler] : samplers_)
    context_.vk.vkDestroySampler(context_.device, sampler, context_.allocation);
}

Result<SamplerHandle> Samplers::find_or_create(const SamplerDesc& desc) {
  const std::lock_guard lock(mutex_);
  for (std::uint32_t i = 0; i < samplers_.size(); ++i) {
    if (samplers_[i].first == desc) return SamplerHandle{i, 1};
  }
  const PhysicalDevice& physical = context_.physical;
  const bool anisotropic = desc.max_anisotropy > 1.0f && physical.features.core.features.samplerAnisotropy == VK_TRUE;
  const VkSamplerCreateInfo info = {
      .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
      .magFilter = to_vulkan(desc.mag_filter),
      .minFilter = to_vulkan(desc.min_filter),
      .mipmapMode = to_mipmap_mode(desc.mip_filter),
      .addressModeU = to_vulkan(desc.address_u),
      .addressModeV = to_vulkan(desc.address_v),
      .addressModeW = to_vulkan(desc.address_v),
      .anisotropyEnable = anisotropic ? VK_TRUE : VK_FALSE,
      .maxAnisotropy = anisotropic ? std::min(desc.max_anisotropy, physical.limits.maxSamplerAnisotropy) : 1.0f,
      .compareEnable = desc.compare ? VK_TRUE : VK_FALSE,
      .compareOp = desc.compare ? to_vulkan(desc.compare_op) : VK_COMPARE_OP_NEVER,
      .maxLod = VK_LOD_CLAMP_NONE};
  VkSampler sampler = VK_NULL_HANDLE;
  const VkResult result = context_.vk.vkCreateSampler(context_.device, &info, context_.allocation, &sampler);
  if (result != VK_SUCCESS) return failure("A sampler could not be made", result);
  context_.set_name(VK_OBJECT_TYPE_SAMPLER, sampler, desc.compare ? "comparing sampler" : "sampler");
  samplers_.emplace_back(desc, sampler);
  return SamplerHandle{static_cast<std::uint32_t>(samplers_.size() - 1), 1};
}

VkSampler Samplers::get(SamplerHandle handle) const {
  const std::lock_guard lock(mutex_);
  GLOAM_ASSERT(handle.generation == 1 && handle.index < samplers_.size(), "a sampler comes from create_sampler");
  return samplers_[handle.index].second;
}

}  // namespace gloam::gpu::vulkan
