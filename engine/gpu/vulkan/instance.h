// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string_view>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/gpu/vulkan/api.h"
#include "engine/gpu/vulkan_device.h"

// Core first; then debug utilities and surfaces, which are null where their extension is absent.
#define GLOAM_VULKAN_INSTANCE_FUNCTIONS(X)     \
  X(vkDestroyInstance)                         \
  X(vkEnumeratePhysicalDevices)                \
  X(vkGetPhysicalDeviceProperties)             \
  X(vkGetPhysicalDeviceProperties2)            \
  X(vkGetPhysicalDeviceFeatures2)              \
  X(vkGetPhysicalDeviceMemoryProperties)       \
  X(vkGetPhysicalDeviceQueueFamilyProperties)  \
  X(vkGetPhysicalDeviceFormatProperties)       \
  X(vkEnumerateDeviceExtensionProperties)      \
  X(vkCreateDevice)                            \
  X(vkGetDeviceProcAddr)                       \
  X(vkCreateDebugUtilsMessengerEXT)            \
  X(vkDestroyDebugUtilsMessengerEXT)           \
  X(vkSetDebugUtilsObjectNameEXT)              \
  X(vkCmdBeginDebugUtilsLabelEXT)              \
  X(vkCmdEndDebugUtilsLabelEXT)                \
  X(vkDestroySurfaceKHR)                       \
  X(vkGetPhysicalDeviceSurfaceSupportKHR)      \
  X(vkGetPhysicalDeviceSurfaceCapabilitiesKHR) \
  X(vkGetPhysicalDeviceSurfaceFormatsKHR)

namespace gloam::gpu::vulkan {

/// Calls of one instance. Tables of our own, because volk's global pointers would tie all devices of a process
/// together.
struct InstanceFunctions {
#define X(name) PFN_##name name = nullptr;
  GLOAM_VULKAN_INSTANCE_FUNCTIONS(X)
#undef X
};

/// A VkInstance with its messenger. Messages of the validation layer go to the log and are counted.
class Instance {
 public:
  static Result<std::unique_ptr<Instance>> create(const VulkanOptions& options);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  [[nodiscard]] VkInstance handle() const { return instance_; }
  [[nodiscard]] const InstanceFunctions& functions() const { return functions_; }
  [[nodiscard]] LogSink& log() const { return *log_; }
  [[nodiscard]] std::uint64_t messages() const { return messages_.load(); }

 private:
  explicit Instance(LogSink& log) : log_(&log) {}
  Status make(const VulkanOptions& options);
  Status make_messenger();
  static VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                   VkDebugUtilsMessageTypeFlagsEXT types,
                                                   const VkDebugUtilsMessengerCallbackDataEXT* data, void* user);

  LogSink* log_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  InstanceFunctions functions_;
  std::atomic<std::uint64_t> messages_ = 0;
};

}  // namespace gloam::gpu::vulkan
