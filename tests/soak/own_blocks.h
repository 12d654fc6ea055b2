// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/gpu/vulkan_interop.h"

namespace gloam::soak {

/// Gives each object a vkAllocateMemory of its own, so that bytes that are in use and bytes that are allocated are the
/// same: in shared blocks, gaps between objects would hide a leak.
class OwnBlocks final : public gpu::HostMemoryAllocator {
 public:
  /// host: instance, device and get_instance_proc_addr are set.
  explicit OwnBlocks(const gpu::HostDevice& host) : device_(host.device) {
    const auto get = [&](const char* name) { return host.get_instance_proc_addr(host.instance, name); };
    const auto of_device = reinterpret_cast<PFN_vkGetDeviceProcAddr>(get("vkGetDeviceProcAddr"));
    allocate_ = reinterpret_cast<PFN_vkAllocateMemory>(of_device(device_, "vkAllocateMemory"));
    free_ = reinterpret_cast<PFN_vkFreeMemory>(of_device(device_, "vkFreeMemory"));
    map_ = reinterpret_cast<PFN_vkMapMemory>(of_device(device_, "vkMapMemory"));
    reinterpret_cast<PFN_vkGetPhysicalDeviceMemoryProperties>(get("vkGetPhysicalDeviceMemoryProperties"))(
        host.physical_device, &properties_);
  }

  VkResult allocate(const gpu::HostMemoryRequest& request, gpu::HostMemory& memory) override {
    const auto fits = [&](std::uint32_t type) {
      return (request.requirements.memoryTypeBits & (1u << type)) != 0 &&
             (properties_.memoryTypes[type].propertyFlags & request.required) == request.required;
    };
    std::uint32_t type = 0;
    while (type + 1 < properties_.memoryTypeCount && !fits(type)) ++type;
    const VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                       .allocationSize = request.requirements.size,
                                       .memoryTypeIndex = type};
    VkResult result = allocate_(device_, &info, nullptr, &memory.memory);
    if (result == VK_SUCCESS && request.mapped)
      result = map_(device_, memory.memory, 0, VK_WHOLE_SIZE, 0, &memory.mapped);
    return result;
  }
  void free(const gpu::HostMemory& memory) override { free_(device_, memory.memory, nullptr); }

 private:
  VkDevice device_;
  PFN_vkAllocateMemory allocate_ = nullptr;
  PFN_vkFreeMemory free_ = nullptr;
  PFN_vkMapMemory map_ = nullptr;
  VkPhysicalDeviceMemoryProperties properties_ = {};
};

}  // namespace gloam::soak
