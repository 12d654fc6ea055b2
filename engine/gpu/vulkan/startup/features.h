// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/gpu/vulkan/api.h"

namespace gloam::gpu::vulkan {

/// The Vulkan 1.0, 1.2 and 1.3 features as a chain for vkGetPhysicalDeviceFeatures2 and vkCreateDevice.
struct Features {
  VkPhysicalDeviceFeatures2 core = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  VkPhysicalDeviceVulkan12Features v12 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
  VkPhysicalDeviceVulkan13Features v13 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  /// Links the structures and returns the first one. The chain is valid until this object is moved or destroyed.
  [[nodiscard]] VkPhysicalDeviceFeatures2* chain();
};

void require_features(VkPhysicalDeviceFeatures& core, VkPhysicalDeviceVulkan12Features& v12,
                      VkPhysicalDeviceVulkan13Features& v13);
/// Enables the optional features that are supported. No effect of the engine requires one of them.
void add_useful_features(const VkPhysicalDeviceFeatures& core_there, VkPhysicalDeviceFeatures& core);

struct RequiredFeature {
  std::string_view name;
  bool of_shaders = false;     ///< needed by the SPIR-V of gloam's shaders, else by a call
  std::string_view needed_by;  ///< what in the SPIR-V needs it, or a Vulkan function that does
};
[[nodiscard]] std::vector<RequiredFeature> required_features();

/// The required features and the supported optional features.
[[nodiscard]] Features features_to_enable(const Features& supported);

/// The names of the required features that are off, separated by commas; empty if all are on.
[[nodiscard]] std::string missing_features(const Features& features);

/// The required and optional features that a chain passed to vkCreateDevice enables. Reads structures of single
/// features as well as those of a whole Vulkan version.
[[nodiscard]] Features features_of_chain(const VkPhysicalDeviceFeatures2& chain);

}  // namespace gloam::gpu::vulkan
