// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "engine/gpu/vulkan/api.h"

namespace gloam::gpu::vulkan {

/// The features this engine knows of, as a chain for vkGetPhysicalDeviceFeatures2 and vkCreateDevice.
struct Features {
  VkPhysicalDeviceFeatures2 core = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  VkPhysicalDeviceVulkan12Features v12 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
  VkPhysicalDeviceVulkan13Features v13 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  /// Links the parts; the chain holds as long as the object stays where it is.
  [[nodiscard]] VkPhysicalDeviceFeatures2* chain();
};

void require_features(VkPhysicalDeviceFeatures& core, VkPhysicalDeviceVulkan12Features& v12,
                      VkPhysicalDeviceVulkan13Features& v13);
/// Adds what is used when there; no effect of the engine depends on one.
void add_useful_features(const VkPhysicalDeviceFeatures& core_there, const VkPhysicalDeviceVulkan12Features& v12_there,
                         VkPhysicalDeviceFeatures& core, VkPhysicalDeviceVulkan12Features& v12);

/// What is required, and what is used when there.
[[nodiscard]] Features features_to_enable(const Features& supported);

/// Names of required features that are off, with commas between; empty when all are on.
[[nodiscard]] std::string missing_features(const Features& features);

/// What a chain that was given to vkCreateDevice turns on, of what this engine knows of. Structures of single features
/// count as much as those of a whole version.
[[nodiscard]] Features features_of_chain(const VkPhysicalDeviceFeatures2& chain);

}  // namespace gloam::gpu::vulkan
