// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/gpu/vulkan_interop.h"

namespace gloam::test {

/// Makes one call of Vulkan fail, seen by a vkGetInstanceProcAddr between gloam and the loader (or another hook of it).
/// Only functions that return a VkResult count as calls. Thread-safe. One object at a time.
///
/// The function that fails is not called, and leaves handles that make no sense, because Vulkan leaves them undefined;
/// pipelines, descriptor sets and command buffers are null, as Vulkan demands. When a device is lost, the GPU is waited
/// for first, because this one goes on, and all later calls that can tell of it do.
class FailingCalls {
 public:
  /// next: the hooked function asks this one for all others.
  explicit FailingCalls(PFN_vkGetInstanceProcAddr next);
  ~FailingCalls();
  FailingCalls(const FailingCalls&) = delete;
  FailingCalls& operator=(const FailingCalls&) = delete;

  /// For get_instance_proc_addr of HostDevice and VulkanOptions.
  [[nodiscard]] static PFN_vkGetInstanceProcAddr loader();

  struct Call {
    std::string function;
    std::uint64_t place = 0;  ///< hash of the callers
  };
  /// Begins to count from 0. The nth call fails with this result, or none does.
  void begin();
  void begin(std::uint64_t nth, VkResult result);
  /// Calls since begin().
  [[nodiscard]] std::vector<Call> calls() const;
  /// Whether the call that was to fail has been made.
  [[nodiscard]] bool has_failed() const;

  /// Whether Vulkan lets a function return VK_ERROR_DEVICE_LOST.
  [[nodiscard]] static bool can_lose_device(const std::string& function);
};

}  // namespace gloam::test
