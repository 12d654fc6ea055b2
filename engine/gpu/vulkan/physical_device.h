// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/api.h"
#include "engine/gpu/vulkan/instance.h"

namespace gloam::gpu::vulkan {

/// The features this engine knows of, as a chain for vkGetPhysicalDeviceFeatures2 and vkCreateDevice.
struct Features {
  VkPhysicalDeviceFeatures2 core = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  VkPhysicalDeviceVulkan12Features v12 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
  VkPhysicalDeviceVulkan13Features v13 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  /// Links the parts; the chain holds as long as the object stays where it is.
  [[nodiscard]] VkPhysicalDeviceFeatures2* chain();
};

/// A device that fits, and what it can do.
struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  DeviceInfo info;
  VkPhysicalDeviceLimits limits = {};
  VkPhysicalDeviceMemoryProperties memory = {};
  Features features;  ///< supported ones, not chained
  std::uint32_t vendor = 0;
  std::uint32_t device = 0;
  std::array<std::uint8_t, VK_UUID_SIZE> cache_uuid = {};
  std::uint64_t max_buffer_size = 0;
  std::uint64_t max_allocation_size = 0;
  std::uint32_t max_push_descriptors = 0;
  std::uint32_t queue_family = 0;
  std::uint32_t timestamp_bits = 0;
  bool can_present = false;
};

/// `wish` as VulkanOptions::device. `for_window`: the device must be able to present.
[[nodiscard]] Result<PhysicalDevice> choose_physical_device(const Instance& instance, std::string_view wish,
                                                            bool for_window);

/// What is required, and what is used when there.
[[nodiscard]] Features features_to_enable(const PhysicalDevice& device);

}  // namespace gloam::gpu::vulkan
