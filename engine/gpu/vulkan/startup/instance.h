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
#include "engine/gpu/vulkan/startup/functions.h"
#include "engine/gpu/vulkan_device.h"
#include "engine/gpu/vulkan_interop.h"

namespace gloam::gpu::vulkan {

/// A VkInstance with its debug messenger. Messages of the validation layer are logged and counted.
class Instance {
 public:
  static Result<std::unique_ptr<Instance>> create(const VulkanOptions& options);
  /// Uses a host's instance, which is not destroyed here. Its validation messages go to the host.
  static Result<std::unique_ptr<Instance>> adopt(const HostDevice& host);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  [[nodiscard]] VkInstance handle() const { return instance_; }
  [[nodiscard]] const InstanceFunctions& functions() const { return functions_; }
  [[nodiscard]] LogSink& log() const { return log_; }
  [[nodiscard]] std::uint64_t messages() const { return messages_.load(); }

 private:
  explicit Instance(LogSink& log) : log_(log, "gpu") {}
  Status make(const VulkanOptions& options);
  Status load_functions(PFN_vkGetInstanceProcAddr get);
  Status make_messenger();
  static VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                   VkDebugUtilsMessageTypeFlagsEXT types,
                                                   const VkDebugUtilsMessengerCallbackDataEXT* data, void* user);

  mutable LogCategory log_;
  VkInstance instance_ = VK_NULL_HANDLE;
  bool owned_ = true;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  InstanceFunctions functions_;
  std::atomic<std::uint64_t> messages_ = 0;
};

}  // namespace gloam::gpu::vulkan
