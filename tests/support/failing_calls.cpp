// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/support/failing_calls.h"

#include <execinfo.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "engine/gpu/vulkan/startup/functions.h"

namespace gloam::test {
namespace {

struct State {
  std::mutex mutex;
  PFN_vkGetInstanceProcAddr next = nullptr;
  PFN_vkGetDeviceProcAddr next_of_device = nullptr;
  PFN_vkDeviceWaitIdle wait_idle = nullptr;
  VkDevice device = VK_NULL_HANDLE;
  std::vector<FailingCalls::Call> calls;
  std::uint64_t failing = ~std::uint64_t{0};
  VkResult result = VK_SUCCESS;
  bool failed = false;
};
State* state = nullptr;

constexpr std::string_view kCanLose[] = {"vkDeviceWaitIdle", "vkGetQueryPoolResults", "vkQueueSubmit2",
                                         "vkQueueWaitIdle",  "vkWaitSemaphores",      "vkGetSemaphoreCounterValue",
                                         "vkGetFenceStatus", "vkAcquireNextImageKHR", "vkQueuePresentKHR"};

bool can_lose(std::string_view function) { return std::ranges::find(kCanLose, function) != std::end(kCanLose); }

/// A hash of the functions that have called the hook.
std::uint64_t callers() {
  std::array<void*, 9> places{};
  const int count = backtrace(places.data(), static_cast<int>(places.size()));
  std::uint64_t hash = 1469598103934665603u;
  for (int i = 2; i < count; ++i)  // without this function and the hook
    hash = (hash ^ reinterpret_cast<std::uintptr_t>(places[static_cast<std::size_t>(i)])) * 1099511628211u;
  return hash;
}

/// Notes a call. Returns what it fails with, or VK_SUCCESS.
VkResult next_result(const char* function) {
  VkResult result = VK_SUCCESS;
  {
    const std::lock_guard lock(state->mutex);
    const bool is_lost = state->failed && state->result == VK_ERROR_DEVICE_LOST && can_lose(function);
    if (state->calls.size() == state->failing || is_lost) {
      result = state->result;
      state->failed = true;
    }
    state->calls.push_back({function, callers()});
  }
  if (result == VK_ERROR_DEVICE_LOST) state->wait_idle(state->device);
  return result;
}

/// Leaves in outputs what a failed call leaves there.
template <class T>
void spoil(std::string_view, T) {}
template <class Handle>
requires std::is_pointer_v<Handle>  // handles are pointers on systems of 64 bits
void spoil(std::string_view function, Handle* output) {
  if constexpr (!std::is_const_v<Handle>) {
    if (!function.starts_with("vkCreate") && function != "vkAllocateMemory") return;
    if (function.ends_with("Pipelines")) {
      *output = nullptr;  // of one: gloam makes each alone
    } else {
      std::memset(static_cast<void*>(output), 0x5a, sizeof *output);
    }
  }
}

template <class Function, int Place>
struct Hook;
template <class... Arguments, int Place>
struct Hook<VkResult(VKAPI_PTR*)(Arguments...), Place> {
  static inline VkResult(VKAPI_PTR* real)(Arguments...) = nullptr;
  static inline const char* name = nullptr;
  static VKAPI_ATTR VkResult VKAPI_CALL call(Arguments... arguments) {
    const VkResult result = next_result(name);
    if (result == VK_SUCCESS) return real(arguments...);
    const auto all = std::tuple<Arguments...>(arguments...);
    spoil(name, std::get<sizeof...(Arguments) - 1>(all));
    return result;
  }
};
/// Other functions cannot fail.
template <class Result, class... Arguments, int Place>
struct Hook<Result(VKAPI_PTR*)(Arguments...), Place> {};

template <class Hooked, class Function>
PFN_vkVoidFunction hook(const char* name, PFN_vkVoidFunction real) {
  if constexpr (requires { Hooked::real; }) {
    Hooked::real = reinterpret_cast<Function>(real);
    Hooked::name = name;
    return reinterpret_cast<PFN_vkVoidFunction>(&Hooked::call);
  } else {
    return real;
  }
}

// Functions of one signature have hooks of their own: Place tells them apart.
enum Place {
#define GLOAM_PLACE(function) place_##function,
  GLOAM_VULKAN_GLOBAL_FUNCTIONS(GLOAM_PLACE) GLOAM_VULKAN_INSTANCE_FUNCTIONS(GLOAM_PLACE)
      GLOAM_VULKAN_OPTIONAL_INSTANCE_FUNCTIONS(GLOAM_PLACE) GLOAM_VULKAN_DEVICE_FUNCTIONS(GLOAM_PLACE)
          GLOAM_VULKAN_OPTIONAL_DEVICE_FUNCTIONS(GLOAM_PLACE)
#undef GLOAM_PLACE
};
#define GLOAM_HOOK(function) \
  if (text == #function) return hook<Hook<PFN_##function, place_##function>, PFN_##function>(#function, real);

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL device_function(VkDevice device, const char* name) {
  const PFN_vkVoidFunction real = state->next_of_device(device, name);
  if (real == nullptr) return nullptr;
  state->device = device;
  const std::string_view text(name);
  if (text == "vkFreeDescriptorSets" || text == "vkResetDescriptorPool") return real;  // they never fail
  if (text == "vkDeviceWaitIdle") state->wait_idle = reinterpret_cast<PFN_vkDeviceWaitIdle>(real);
  GLOAM_VULKAN_DEVICE_FUNCTIONS(GLOAM_HOOK)
  GLOAM_VULKAN_OPTIONAL_DEVICE_FUNCTIONS(GLOAM_HOOK)
  return real;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instance_function(VkInstance instance, const char* name) {
  const PFN_vkVoidFunction real = state->next(instance, name);
  const std::string_view text(name);
  if (real == nullptr || text == "vkSetDebugUtilsObjectNameEXT") return real;  // a name that is missing harms nothing
  if (text == "vkGetDeviceProcAddr") {
    state->next_of_device = reinterpret_cast<PFN_vkGetDeviceProcAddr>(real);
    return reinterpret_cast<PFN_vkVoidFunction>(&device_function);
  }
  GLOAM_VULKAN_GLOBAL_FUNCTIONS(GLOAM_HOOK)
  GLOAM_VULKAN_INSTANCE_FUNCTIONS(GLOAM_HOOK)
  GLOAM_VULKAN_OPTIONAL_INSTANCE_FUNCTIONS(GLOAM_HOOK)
  return real;
}
#undef GLOAM_HOOK

}  // namespace

FailingCalls::FailingCalls(PFN_vkGetInstanceProcAddr next) {
  state = new State;
  state->next = next;
}
FailingCalls::~FailingCalls() {
  delete state;
  state = nullptr;
}
PFN_vkGetInstanceProcAddr FailingCalls::loader() { return &instance_function; }

void FailingCalls::begin() { begin(~std::uint64_t{0}, VK_SUCCESS); }
void FailingCalls::begin(std::uint64_t nth, VkResult result) {
  const std::lock_guard lock(state->mutex);
  state->calls.clear();
  state->failing = nth;
  state->result = result;
  state->failed = false;
}
std::vector<FailingCalls::Call> FailingCalls::calls() const {
  const std::lock_guard lock(state->mutex);
  return state->calls;
}
bool FailingCalls::has_failed() const {
  const std::lock_guard lock(state->mutex);
  return state->failed;
}
bool FailingCalls::can_lose_device(const std::string& function) { return can_lose(function); }

}  // namespace gloam::test
