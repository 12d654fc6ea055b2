// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string_view>

#include "engine/core/result.h"
#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/api.h"
#include "engine/gpu/vulkan/startup/functions.h"
#include "engine/gpu/vulkan/startup/instance.h"
#include "engine/gpu/vulkan/startup/physical_device.h"
#include "engine/gpu/vulkan_interop.h"

namespace gloam::gpu::vulkan {

/// The VkDevice with its queue, limits and function table. All parts of this layer call Vulkan through it; it outlives
/// them.
class Context {
 public:
  static Result<std::unique_ptr<Context>> create(const Instance& instance, const PhysicalDevice& physical);
  /// Uses a host's device, which is not destroyed here. `physical`: from examine_host_device.
  static Result<std::unique_ptr<Context>> adopt(const Instance& instance, const PhysicalDevice& physical,
                                                const HostDevice& host);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  [[nodiscard]] const InstanceFunctions& instance_functions() const { return instance_->functions(); }
  [[nodiscard]] VkInstance instance() const { return instance_->handle(); }
  [[nodiscard]] LogSink& log() const { return instance_->log(); }
  [[nodiscard]] std::uint64_t messages() const { return instance_->messages(); }

  /// Sets the name that captures and validation messages show; does nothing without VK_EXT_debug_utils.
  template <class T>
  void set_name(VkObjectType type, T object, std::string_view name) const {
    set_object_name(type, (std::uint64_t)object, name);  // a handle is a pointer or an integer, by platform
  }

  /// Must be locked around every use of the queue: submitting and presenting are not thread-safe in Vulkan.
  [[nodiscard]] std::mutex& queue_mutex() { return *queue_mutex_; }
  /// False on a host's device.
  [[nodiscard]] bool owns_device() const { return owned_; }

  PhysicalDevice physical;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  DeviceFunctions vk;
  /// Of the host; passed to every call that takes callbacks. Null: the driver allocates by itself.
  const VkAllocationCallbacks* allocation = nullptr;

 private:
  explicit Context(const Instance& instance, const PhysicalDevice& chosen) : physical(chosen), instance_(&instance) {}
  void set_object_name(VkObjectType type, std::uint64_t object, std::string_view name) const;

  Status load_functions();

  const Instance* instance_;
  bool owned_ = true;
  VkAllocationCallbacks callbacks_ = {};  ///< the host's, to which `allocation` points
  std::mutex own_queue_mutex_;
  std::mutex* queue_mutex_ = &own_queue_mutex_;
};

}  // namespace gloam::gpu::vulkan
