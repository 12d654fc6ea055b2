// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "watched_names.h"

#include <cstdint>
#include <cstring>
#include <map>
#include <mutex>
#include <set>

namespace host {
namespace {

/// Vulkan's function pointers have no user data, so what is noted is global.
struct Notes {
  std::mutex mutex;
  VkInstance instance = VK_NULL_HANDLE;
  std::size_t created = 0;
  std::map<std::uint64_t, std::string> unnamed;  ///< by handle: the function that has created it
  std::set<std::string> names, labels;
};
Notes& notes() {
  static Notes all;
  return all;
}

template <class Handle>
void note_created(Handle handle, const char* function) {
  const std::lock_guard lock(notes().mutex);
  ++notes().created;
  notes().unnamed[(std::uint64_t)handle] = function;  // a pointer or an integer, by platform
}

/// A function that creates one object: vkCreateBuffer(device, info, allocator, result) and its like.
template <class Function>
struct Creation;
template <class Info, class Handle>
struct Creation<VkResult(VKAPI_PTR*)(VkDevice, const Info*, const VkAllocationCallbacks*, Handle*)> {
  template <auto function, const char* const* name>
  static VkResult VKAPI_CALL watched(VkDevice device, const Info* info, const VkAllocationCallbacks* allocator,
                                     Handle* result) {
    const VkResult status = function(device, info, allocator, result);
    if (status == VK_SUCCESS) note_created(*result, *name);
    return status;
  }
};
/// Creates several pipelines.
template <class Info>
struct Creation<VkResult(VKAPI_PTR*)(VkDevice, VkPipelineCache, std::uint32_t, const Info*,
                                     const VkAllocationCallbacks*, VkPipeline*)> {
  template <auto function, const char* const* name>
  static VkResult VKAPI_CALL watched(VkDevice device, VkPipelineCache cache, std::uint32_t count, const Info* infos,
                                     const VkAllocationCallbacks* allocator, VkPipeline* results) {
    const VkResult status = function(device, cache, count, infos, allocator, results);
    for (std::uint32_t i = 0; i < count && status == VK_SUCCESS; ++i) note_created(results[i], *name);
    return status;
  }
};

VkResult VKAPI_CALL name_object(VkDevice device, const VkDebugUtilsObjectNameInfoEXT* info) {
  {
    const std::lock_guard lock(notes().mutex);
    if (info->pObjectName != nullptr && *info->pObjectName != '\0') {
      notes().unnamed.erase(info->objectHandle);
      notes().names.insert(info->pObjectName);
    }
  }
  static const auto real = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(
      vkGetInstanceProcAddr(notes().instance, "vkSetDebugUtilsObjectNameEXT"));
  return real(device, info);
}

void VKAPI_CALL begin_label(VkCommandBuffer commands, const VkDebugUtilsLabelEXT* label) {
  {
    const std::lock_guard lock(notes().mutex);
    notes().labels.insert(label->pLabelName);
  }
  static const auto real = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(
      vkGetInstanceProcAddr(notes().instance, "vkCmdBeginDebugUtilsLabelEXT"));
  real(commands, label);
}

PFN_vkVoidFunction VKAPI_CALL watching_device_proc_addr(VkDevice device, const char* name) {
#define WATCH(function)                                        \
  static constexpr const char* name_of_##function = #function; \
  if (std::strcmp(name, #function) == 0)                       \
    return reinterpret_cast<PFN_vkVoidFunction>(               \
        &Creation<decltype(&::function)>::template watched<&::function, &name_of_##function>);
  WATCH(vkCreateBuffer)
  WATCH(vkCreateCommandPool)
  WATCH(vkCreateComputePipelines)
  WATCH(vkCreateDescriptorPool)
  WATCH(vkCreateDescriptorSetLayout)
  WATCH(vkCreateGraphicsPipelines)
  WATCH(vkCreateImage)
  WATCH(vkCreateImageView)
  WATCH(vkCreatePipelineCache)
  WATCH(vkCreatePipelineLayout)
  WATCH(vkCreateQueryPool)
  WATCH(vkCreateSampler)
  WATCH(vkCreateSemaphore)
  WATCH(vkCreateShaderModule)
  WATCH(vkAllocateMemory)
#undef WATCH
  return vkGetDeviceProcAddr(device, name);
}

}  // namespace

PFN_vkVoidFunction VKAPI_CALL watching_proc_addr(VkInstance instance, const char* name) {
  if (instance != VK_NULL_HANDLE) notes().instance = instance;
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0)
    return reinterpret_cast<PFN_vkVoidFunction>(&watching_device_proc_addr);
  const PFN_vkVoidFunction real = vkGetInstanceProcAddr(instance, name);
  if (real == nullptr) return nullptr;
  if (std::strcmp(name, "vkSetDebugUtilsObjectNameEXT") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&name_object);
  if (std::strcmp(name, "vkCmdBeginDebugUtilsLabelEXT") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&begin_label);
  return real;
}

WatchedNames watched_names() {
  const std::lock_guard lock(notes().mutex);
  WatchedNames watched;
  watched.created = notes().created;
  for (const auto& [handle, function] : notes().unnamed) watched.unnamed.push_back(function);
  watched.names.assign(notes().names.begin(), notes().names.end());
  watched.labels.assign(notes().labels.begin(), notes().labels.end());
  return watched;
}

}  // namespace host
