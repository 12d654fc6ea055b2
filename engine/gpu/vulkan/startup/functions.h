// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/gpu/vulkan/api.h"

// The Vulkan functions that this layer calls: global, of an instance, and of a device. Optional functions are null if
// their extension is not enabled.
#define GLOAM_VULKAN_GLOBAL_FUNCTIONS(X)    \
  X(vkEnumerateInstanceVersion)             \
  X(vkEnumerateInstanceLayerProperties)     \
  X(vkEnumerateInstanceExtensionProperties) \
  X(vkCreateInstance)

#define GLOAM_VULKAN_INSTANCE_FUNCTIONS(X)    \
  X(vkDestroyInstance)                        \
  X(vkEnumeratePhysicalDevices)               \
  X(vkGetPhysicalDeviceProperties)            \
  X(vkGetPhysicalDeviceProperties2)           \
  X(vkGetPhysicalDeviceFeatures2)             \
  X(vkGetPhysicalDeviceMemoryProperties)      \
  X(vkGetPhysicalDeviceQueueFamilyProperties) \
  X(vkGetPhysicalDeviceFormatProperties)      \
  X(vkEnumerateDeviceExtensionProperties)     \
  X(vkCreateDevice)                           \
  X(vkGetDeviceProcAddr)

#define GLOAM_VULKAN_OPTIONAL_INSTANCE_FUNCTIONS(X) \
  X(vkCreateDebugUtilsMessengerEXT)                 \
  X(vkDestroyDebugUtilsMessengerEXT)                \
  X(vkSetDebugUtilsObjectNameEXT)                   \
  X(vkCmdBeginDebugUtilsLabelEXT)                   \
  X(vkCmdEndDebugUtilsLabelEXT)                     \
  X(vkDestroySurfaceKHR)                            \
  X(vkGetPhysicalDeviceSurfaceSupportKHR)           \
  X(vkGetPhysicalDeviceSurfaceCapabilitiesKHR)      \
  X(vkGetPhysicalDeviceSurfaceFormatsKHR)

#define GLOAM_VULKAN_DEVICE_FUNCTIONS(X) \
  X(vkAllocateCommandBuffers)            \
  X(vkAllocateDescriptorSets)            \
  X(vkAllocateMemory)                    \
  X(vkBeginCommandBuffer)                \
  X(vkBindBufferMemory)                  \
  X(vkBindImageMemory)                   \
  X(vkCmdBeginRendering)                 \
  X(vkCmdBindDescriptorSets)             \
  X(vkCmdBindIndexBuffer)                \
  X(vkCmdBindPipeline)                   \
  X(vkCmdBindVertexBuffers)              \
  X(vkCmdBlitImage)                      \
  X(vkCmdClearColorImage)                \
  X(vkCmdCopyBuffer)                     \
  X(vkCmdCopyBufferToImage)              \
  X(vkCmdCopyImageToBuffer)              \
  X(vkCmdDispatch)                       \
  X(vkCmdDispatchIndirect)               \
  X(vkCmdDraw)                           \
  X(vkCmdDrawIndexed)                    \
  X(vkCmdDrawIndirect)                   \
  X(vkCmdDrawIndexedIndirect)            \
  X(vkCmdEndRendering)                   \
  X(vkCmdFillBuffer)                     \
  X(vkCmdPipelineBarrier2)               \
  X(vkCmdPushConstants)                  \
  X(vkCmdResetQueryPool)                 \
  X(vkCmdSetDepthBias)                   \
  X(vkCmdSetScissor)                     \
  X(vkCmdSetViewport)                    \
  X(vkCmdWriteTimestamp2)                \
  X(vkCreateBuffer)                      \
  X(vkCreateCommandPool)                 \
  X(vkCreateComputePipelines)            \
  X(vkCreateDescriptorPool)              \
  X(vkCreateDescriptorSetLayout)         \
  X(vkCreateGraphicsPipelines)           \
  X(vkCreateImage)                       \
  X(vkCreateImageView)                   \
  X(vkCreatePipelineCache)               \
  X(vkCreatePipelineLayout)              \
  X(vkCreateQueryPool)                   \
  X(vkCreateSampler)                     \
  X(vkCreateSemaphore)                   \
  X(vkCreateShaderModule)                \
  X(vkDestroyBuffer)                     \
  X(vkDestroyCommandPool)                \
  X(vkDestroyDescriptorPool)             \
  X(vkDestroyDescriptorSetLayout)        \
  X(vkDestroyDevice)                     \
  X(vkDestroyImage)                      \
  X(vkDestroyImageView)                  \
  X(vkDestroyPipeline)                   \
  X(vkDestroyPipelineCache)              \
  X(vkDestroyPipelineLayout)             \
  X(vkDestroyQueryPool)                  \
  X(vkDestroySampler)                    \
  X(vkDestroySemaphore)                  \
  X(vkDestroyShaderModule)               \
  X(vkDeviceWaitIdle)                    \
  X(vkEndCommandBuffer)                  \
  X(vkFreeDescriptorSets)                \
  X(vkFreeMemory)                        \
  X(vkGetBufferMemoryRequirements)       \
  X(vkGetDeviceBufferMemoryRequirements) \
  X(vkGetDeviceImageMemoryRequirements)  \
  X(vkGetDeviceQueue)                    \
  X(vkGetImageMemoryRequirements)        \
  X(vkGetPipelineCacheData)              \
  X(vkGetQueryPoolResults)               \
  X(vkGetSemaphoreCounterValue)          \
  X(vkMapMemory)                         \
  X(vkQueueSubmit2)                      \
  X(vkQueueWaitIdle)                     \
  X(vkResetCommandPool)                  \
  X(vkResetDescriptorPool)               \
  X(vkUpdateDescriptorSets)              \
  X(vkWaitSemaphores)

#define GLOAM_VULKAN_OPTIONAL_DEVICE_FUNCTIONS(X) \
  X(vkAcquireNextImageKHR)                        \
  X(vkCmdPushDescriptorSetKHR)                    \
  X(vkCreateSwapchainKHR)                         \
  X(vkDestroySwapchainKHR)                        \
  X(vkGetSwapchainImagesKHR)                      \
  X(vkQueuePresentKHR)

namespace gloam::gpu::vulkan {

// Each instance and each device has its own function table. Global pointers would tie all devices of a process
// together, and under Vulkan's own names they would clash with the loader that a host links.
#define X(name) PFN_##name name = nullptr;
struct GlobalFunctions {
  GLOAM_VULKAN_GLOBAL_FUNCTIONS(X)
};
struct InstanceFunctions {
  GLOAM_VULKAN_INSTANCE_FUNCTIONS(X)
  GLOAM_VULKAN_OPTIONAL_INSTANCE_FUNCTIONS(X)
};
struct DeviceFunctions {
  GLOAM_VULKAN_DEVICE_FUNCTIONS(X)
  GLOAM_VULKAN_OPTIONAL_DEVICE_FUNCTIONS(X)
};
#undef X

/// vkGetInstanceProcAddr of the installed Vulkan loader; null if there is none. The loader is opened once per process
/// and never closed.
[[nodiscard]] PFN_vkGetInstanceProcAddr find_loader();

/// Each fails with ErrorKind::no_device if a required function is missing; the error names the first one.
[[nodiscard]] Result<GlobalFunctions> load_global_functions(PFN_vkGetInstanceProcAddr get);
[[nodiscard]] Result<InstanceFunctions> load_instance_functions(PFN_vkGetInstanceProcAddr get, VkInstance instance);
[[nodiscard]] Result<DeviceFunctions> load_device_functions(PFN_vkGetDeviceProcAddr get, VkDevice device);

}  // namespace gloam::gpu::vulkan
