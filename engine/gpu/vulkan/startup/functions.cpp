// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/startup/functions.h"

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

#include <string>

namespace gloam::gpu::vulkan {
namespace {

PFN_vkGetInstanceProcAddr open_loader() {
#ifdef _WIN32
  const HMODULE library = LoadLibraryA("vulkan-1.dll");
  if (library == nullptr) return nullptr;
  return reinterpret_cast<PFN_vkGetInstanceProcAddr>(
      reinterpret_cast<void*>(GetProcAddress(library, "vkGetInstanceProcAddr")));
#else
  for (const char* name : {"libvulkan.so.1", "libvulkan.so"}) {
    void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) continue;
    return reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
  }
  return nullptr;
#endif
}

Error lacks(const char* what, const char* name) {
  return {ErrorKind::no_device, std::string("The Vulkan ") + what + " has no " + name};
}

}  // namespace

PFN_vkGetInstanceProcAddr find_loader() {
  static const PFN_vkGetInstanceProcAddr loader = open_loader();
  return loader;
}

#define FIND(name) functions.name = reinterpret_cast<PFN_##name>(get(from, #name));
#define REQUIRE(name) \
  FIND(name)          \
  if (functions.name == nullptr) return lacks(what, #name);

Result<GlobalFunctions> load_global_functions(PFN_vkGetInstanceProcAddr get) {
  constexpr const char* what = "loader";
  constexpr VkInstance from = VK_NULL_HANDLE;
  GlobalFunctions functions;
  GLOAM_VULKAN_GLOBAL_FUNCTIONS(REQUIRE)
  return functions;
}

Result<InstanceFunctions> load_instance_functions(PFN_vkGetInstanceProcAddr get, VkInstance from) {
  constexpr const char* what = "instance";
  InstanceFunctions functions;
  GLOAM_VULKAN_INSTANCE_FUNCTIONS(REQUIRE)
  GLOAM_VULKAN_OPTIONAL_INSTANCE_FUNCTIONS(FIND)
  return functions;
}

Result<DeviceFunctions> load_device_functions(PFN_vkGetDeviceProcAddr get, VkDevice from) {
  constexpr const char* what = "device";
  DeviceFunctions functions;
  GLOAM_VULKAN_DEVICE_FUNCTIONS(REQUIRE)
  GLOAM_VULKAN_OPTIONAL_DEVICE_FUNCTIONS(FIND)
  return functions;
}

#undef REQUIRE
#undef FIND

}  // namespace gloam::gpu::vulkan
