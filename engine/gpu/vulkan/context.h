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
#include "engine/gpu/vulkan/instance.h"
#include "engine/gpu/vulkan/physical_device.h"

namespace gloam::gpu::vulkan {

/// The VkDevice, its queue and its limits: what every part of this layer needs to make calls. Outlives them all.
class Context {
 public:
  static Result<std::unique_ptr<Context>> create(const Instance& instance, const PhysicalDevice& physical);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  [[nodiscard]] const InstanceFunctions& instance_functions() const { return instance_->functions(); }
  [[nodiscard]] VkInstance instance() const { return instance_->handle(); }
  [[nodiscard]] LogSink& log() const { return instance_->log(); }
  [[nodiscard]] std::uint64_t messages() const { return instance_->messages(); }

  /// Shows `name` in captures and validation messages, where the driver can.
  template <class T>
  void set_name(VkObjectType type, T object, std::string_view name) const {
    set_object_name(type, (std::uint64_t)object, name);  // a pointer or an integer, by platform
  }

  PhysicalDevice physical;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  std::mutex queue_mutex;  ///< submitting and presenting are not thread-safe in Vulkan
  VolkDeviceTable vk = {};

 private:
  explicit Context(const Instance& instance, const PhysicalDevice& chosen) : physical(chosen), instance_(&instance) {}
  void set_object_name(VkObjectType type, std::uint64_t object, std::string_view name) const;

  const Instance* instance_;
};

}  // namespace gloam::gpu::vulkan
