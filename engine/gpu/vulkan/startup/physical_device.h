// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/api.h"
#include "engine/gpu/vulkan/startup/features.h"
#include "engine/gpu/vulkan/startup/instance.h"
#include "engine/gpu/vulkan_interop.h"

namespace gloam::gpu::vulkan {

/// A usable physical device with its properties.
struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  DeviceInfo info;
  VkPhysicalDeviceLimits limits = {};
  VkPhysicalDeviceMemoryProperties memory = {};
  Features features;  ///< the supported ones, on a host's device the enabled ones; not chained
  std::uint32_t vendor = 0;
  std::uint32_t device = 0;
  std::array<std::uint8_t, VK_UUID_SIZE> cache_uuid = {};
  std::uint64_t max_buffer_size = 0;
  std::uint64_t max_allocation_size = 0;
  bool push_descriptors = false;  ///< VK_KHR_push_descriptor is (to be) enabled
  std::uint32_t max_push_descriptors = 0;
  std::uint32_t queue_family = 0;
  std::uint32_t timestamp_bits = 0;
  bool can_present = false;
  /// llvmpipe compiles depth tests for vectors of 128 and 256 bits only; its compiler crashes at other widths.
  bool crashes_at_depth_tests = false;
  /// The driver compiles shaders anew when uniforms change that decide branches: see hide_uniform_conditions.
  bool compiles_for_uniforms = false;
  /// As VulkanOptions::split_selections.
  std::optional<bool> split_selections;
};

/// The surface that a device must be able to present to.
struct WindowNeeds {
  bool present = false;                   ///< false: there is no window
  VkSurfaceKHR surface = VK_NULL_HANDLE;  ///< VK_NULL_HANDLE: any surface
};

/// `wish`: as VulkanOptions::device. Fails with ErrorKind::no_device if no device fits.
[[nodiscard]] Result<PhysicalDevice> choose_physical_device(const Instance& instance, std::string_view wish,
                                                            const WindowNeeds& window);

/// Examines a host's device. Fails with ErrorKind::no_device; the error names everything that the device lacks or that
/// the host has not enabled.
[[nodiscard]] Result<PhysicalDevice> examine_host_device(const Instance& instance, const HostDevice& host);

}  // namespace gloam::gpu::vulkan
