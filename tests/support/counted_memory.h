// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <set>
#include <string>

#include "engine/gpu/vulkan_interop.h"

namespace gloam::test {

/// VkAllocationCallbacks that count bytes. Thread-safe. Must outlive all objects that were created with them.
class CountingCallbacks {
 public:
  CountingCallbacks();
  CountingCallbacks(const CountingCallbacks&) = delete;
  CountingCallbacks& operator=(const CountingCallbacks&) = delete;

  [[nodiscard]] const VkAllocationCallbacks* get() const { return &callbacks_; }
  [[nodiscard]] std::int64_t live_bytes() const { return live_bytes_; }
  [[nodiscard]] std::uint64_t calls() const { return calls_; }

 private:
  static VKAPI_ATTR void* VKAPI_CALL allocate(void* user, std::size_t size, std::size_t alignment,
                                              VkSystemAllocationScope scope);
  static VKAPI_ATTR void* VKAPI_CALL reallocate(void* user, void* original, std::size_t size, std::size_t alignment,
                                                VkSystemAllocationScope scope);
  static VKAPI_ATTR void VKAPI_CALL free(void* user, void* memory);

  std::atomic<std::int64_t> live_bytes_ = 0;
  std::atomic<std::uint64_t> calls_ = 0;
  VkAllocationCallbacks callbacks_ = {};
};

/// The calls of one gpu::Device that create and destroy Vulkan objects, seen by a vkGetInstanceProcAddr between gloam
/// and the loader. One watch at a time.
class CallWatch {
 public:
  CallWatch();
  ~CallWatch();
  CallWatch(const CallWatch&) = delete;
  CallWatch& operator=(const CallWatch&) = delete;

  /// For HostDevice::get_instance_proc_addr.
  [[nodiscard]] static PFN_vkGetInstanceProcAddr loader();

  /// Functions that were called without callbacks.
  [[nodiscard]] std::set<std::string> without_callbacks() const;
  /// Functions that were called.
  [[nodiscard]] std::set<std::string> called() const;
  /// Functions that create or destroy objects, were asked for, and are not watched.
  [[nodiscard]] std::set<std::string> unknown() const;
  /// Bytes of vkAllocateMemory that were not freed, and the most that there ever were.
  [[nodiscard]] std::uint64_t live_bytes() const;
  [[nodiscard]] std::uint64_t most_bytes() const;
};

}  // namespace gloam::test
