// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/binding/descriptor_pool.h"

#include "engine/gpu/vulkan/convert.h"

namespace gloam::gpu::vulkan {

DescriptorCounts count_descriptors(std::span<const ReflectedBinding> bindings) {
  DescriptorCounts counts = {};
  for (const ReflectedBinding& binding : bindings) {
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (binding.kind == kDescriptorKinds[i]) counts[i] += binding.count;
    }
  }
  return counts;
}

VkResult create_descriptor_pool(const Context& context, VkDescriptorPoolCreateFlags flags, std::uint32_t sets,
                                const DescriptorCounts& counts, VkDescriptorPool& pool) {
  std::array<VkDescriptorPoolSize, kDescriptorKinds.size()> sizes = {};
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = {to_vulkan(kDescriptorKinds[i]), counts[i]};
  const VkDescriptorPoolCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                           .flags = flags,
                                           .maxSets = sets,
                                           .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
                                           .pPoolSizes = sizes.data()};
  return context.vk.vkCreateDescriptorPool(context.device, &info, context.allocation, &pool);
}

}  // namespace gloam::gpu::vulkan
