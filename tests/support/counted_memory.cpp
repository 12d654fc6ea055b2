// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/support/counted_memory.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <string_view>
#include <type_traits>

#include "engine/gpu/vulkan/startup/functions.h"

namespace gloam::test {
namespace {

/// What lies before each allocation.
struct Header {
  void* begin = nullptr;
  std::size_t size = 0;
};

Header* header_of(void* memory) { return static_cast<Header*>(memory) - 1; }

}  // namespace

CountingCallbacks::CountingCallbacks() {
  callbacks_ = {.pUserData = this, .pfnAllocation = &allocate, .pfnReallocation = &reallocate, .pfnFree = &free};
}

void* CountingCallbacks::allocate(void* user, std::size_t size, std::size_t alignment, VkSystemAllocationScope) {
  auto* self = static_cast<CountingCallbacks*>(user);
  alignment = std::max(alignment, alignof(Header));
  auto* begin = static_cast<std::byte*>(std::malloc(size + alignment + sizeof(Header)));
  if (begin == nullptr) return nullptr;
  const auto first = reinterpret_cast<std::uintptr_t>(begin) + sizeof(Header);
  std::byte* memory = begin + sizeof(Header) + ((alignment - first % alignment) % alignment);
  *header_of(memory) = {begin, size};
  self->live_bytes_ += static_cast<std::int64_t>(size);
  ++self->calls_;
  return memory;
}

void* CountingCallbacks::reallocate(void* user, void* original, std::size_t size, std::size_t alignment,
                                    VkSystemAllocationScope scope) {
  void* made = size > 0 ? allocate(user, size, alignment, scope) : nullptr;
  if (made != nullptr && original != nullptr) std::memcpy(made, original, std::min(size, header_of(original)->size));
  if (made != nullptr || size == 0) free(user, original);
  return made;
}

void CountingCallbacks::free(void* user, void* memory) {
  if (memory == nullptr) return;
  static_cast<CountingCallbacks*>(user)->live_bytes_ -= static_cast<std::int64_t>(header_of(memory)->size);
  std::free(header_of(memory)->begin);
}

namespace {

/// What the watch has seen.
struct Seen {
  std::mutex mutex;
  std::set<std::string> called, without_callbacks, unknown;
  std::map<VkDeviceMemory, std::uint64_t> memory;
  std::uint64_t live_bytes = 0;
  std::uint64_t most_bytes = 0;
};
Seen* seen = nullptr;

void note(const char* name, bool has_callbacks) {
  if (seen == nullptr) return;
  const std::lock_guard lock(seen->mutex);
  seen->called.insert(name);
  if (!has_callbacks) seen->without_callbacks.insert(name);
}

void note_memory(VkDeviceMemory memory, std::uint64_t bytes) {
  if (seen == nullptr) return;
  const std::lock_guard lock(seen->mutex);
  seen->memory[memory] = bytes;
  seen->live_bytes += bytes;
  seen->most_bytes = std::max(seen->most_bytes, seen->live_bytes);
}

void note_freed(VkDeviceMemory memory) {
  if (seen == nullptr) return;
  const std::lock_guard lock(seen->mutex);
  const auto found = seen->memory.find(memory);
  if (found == seen->memory.end()) return;
  seen->live_bytes -= found->second;
  seen->memory.erase(found);
}

/// Calls a Vulkan function and notes whether it got callbacks. Line tells functions of one signature apart.
template <class Function, int Line>
struct Hook;
template <class Result, class... Arguments, int Line>
struct Hook<Result(VKAPI_PTR*)(Arguments...), Line> {
  static inline Result(VKAPI_PTR* real)(Arguments...) = nullptr;
  static inline const char* name = nullptr;
  static VKAPI_ATTR Result VKAPI_CALL call(Arguments... arguments) {
    const auto has = [](const auto& argument) {
      if constexpr (std::is_same_v<std::decay_t<decltype(argument)>, const VkAllocationCallbacks*>)
        return argument != nullptr;
      return false;
    };
    note(name, (has(arguments) || ...));
    return real(arguments...);
  }
};

PFN_vkAllocateMemory real_allocate = nullptr;
VKAPI_ATTR VkResult VKAPI_CALL allocate_memory(VkDevice device, const VkMemoryAllocateInfo* info,
                                               const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory) {
  note("vkAllocateMemory", callbacks != nullptr);
  const VkResult result = real_allocate(device, info, callbacks, memory);
  if (result == VK_SUCCESS) note_memory(*memory, info->allocationSize);
  return result;
}
PFN_vkFreeMemory real_free = nullptr;
VKAPI_ATTR void VKAPI_CALL free_memory(VkDevice device, VkDeviceMemory memory, const VkAllocationCallbacks* callbacks) {
  note("vkFreeMemory", callbacks != nullptr);
  note_freed(memory);
  real_free(device, memory, callbacks);
}

/// The function to call in place of `real`; null if it is not watched.
PFN_vkVoidFunction hook_of(std::string_view name, PFN_vkVoidFunction real) {
#define GLOAM_WATCH(function)                                   \
  if (name == #function) {                                      \
    using Hooked = Hook<PFN_##function, __LINE__>;              \
    Hooked::real = reinterpret_cast<PFN_##function>(real);      \
    Hooked::name = #function;                                   \
    return reinterpret_cast<PFN_vkVoidFunction>(&Hooked::call); \
  }
  GLOAM_WATCH(vkCreateBuffer)
  GLOAM_WATCH(vkDestroyBuffer)
  GLOAM_WATCH(vkCreateImage)
  GLOAM_WATCH(vkDestroyImage)
  GLOAM_WATCH(vkCreateImageView)
  GLOAM_WATCH(vkDestroyImageView)
  GLOAM_WATCH(vkCreateSampler)
  GLOAM_WATCH(vkDestroySampler)
  GLOAM_WATCH(vkCreateShaderModule)
  GLOAM_WATCH(vkDestroyShaderModule)
  GLOAM_WATCH(vkCreatePipelineCache)
  GLOAM_WATCH(vkDestroyPipelineCache)
  GLOAM_WATCH(vkCreateComputePipelines)
  GLOAM_WATCH(vkCreateGraphicsPipelines)
  GLOAM_WATCH(vkDestroyPipeline)
  GLOAM_WATCH(vkCreatePipelineLayout)
  GLOAM_WATCH(vkDestroyPipelineLayout)
  GLOAM_WATCH(vkCreateDescriptorSetLayout)
  GLOAM_WATCH(vkDestroyDescriptorSetLayout)
  GLOAM_WATCH(vkCreateDescriptorPool)
  GLOAM_WATCH(vkDestroyDescriptorPool)
  GLOAM_WATCH(vkCreateCommandPool)
  GLOAM_WATCH(vkDestroyCommandPool)
  GLOAM_WATCH(vkCreateQueryPool)
  GLOAM_WATCH(vkDestroyQueryPool)
  GLOAM_WATCH(vkCreateSemaphore)
  GLOAM_WATCH(vkDestroySemaphore)
#undef GLOAM_WATCH
  return nullptr;
}

PFN_vkGetDeviceProcAddr real_device_functions = nullptr;
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL device_function(VkDevice device, const char* name) {
  const PFN_vkVoidFunction real = real_device_functions(device, name);
  const std::string_view text(name);
  if (real == nullptr || seen == nullptr) return real;
  if (text == "vkAllocateMemory") {
    real_allocate = reinterpret_cast<PFN_vkAllocateMemory>(real);
    return reinterpret_cast<PFN_vkVoidFunction>(&allocate_memory);
  }
  if (text == "vkFreeMemory") {
    real_free = reinterpret_cast<PFN_vkFreeMemory>(real);
    return reinterpret_cast<PFN_vkVoidFunction>(&free_memory);
  }
  if (const PFN_vkVoidFunction hook = hook_of(text, real)) return hook;
  // Swapchains belong to a window, and the device itself to the host.
  const bool creates = text.starts_with("vkCreate") || text.starts_with("vkDestroy");
  const bool of_host = text.find("Swapchain") != text.npos || text == "vkDestroyDevice";
  const std::lock_guard lock(seen->mutex);
  if (creates && !of_host) seen->unknown.insert(name);
  return real;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instance_function(VkInstance instance, const char* name) {
  const PFN_vkVoidFunction real = gpu::vulkan::find_loader()(instance, name);
  if (std::string_view(name) != "vkGetDeviceProcAddr") return real;
  real_device_functions = reinterpret_cast<PFN_vkGetDeviceProcAddr>(real);
  return reinterpret_cast<PFN_vkVoidFunction>(&device_function);
}

}  // namespace

CallWatch::CallWatch() { seen = new Seen; }
CallWatch::~CallWatch() {
  delete seen;
  seen = nullptr;
}
PFN_vkGetInstanceProcAddr CallWatch::loader() { return &instance_function; }
std::set<std::string> CallWatch::without_callbacks() const { return seen->without_callbacks; }
std::set<std::string> CallWatch::called() const { return seen->called; }
std::set<std::string> CallWatch::unknown() const { return seen->unknown; }
std::uint64_t CallWatch::live_bytes() const { return seen->live_bytes; }
std::uint64_t CallWatch::most_bytes() const { return seen->most_bytes; }

}  // namespace gloam::test
