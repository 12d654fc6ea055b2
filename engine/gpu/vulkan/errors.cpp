// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/errors.h"

namespace gloam::gpu::vulkan {

std::string describe(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "out of host memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "out of device memory";
    case VK_ERROR_DEVICE_LOST:
      return "the device was lost";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "the driver could not be initialised";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "no installed driver is compatible";
    case VK_ERROR_TOO_MANY_OBJECTS:
      return "too many objects";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "a feature is not present";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "an extension is not present";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "a layer is not present";
    case VK_ERROR_SURFACE_LOST_KHR:
      return "the window's surface was lost";
    case VK_ERROR_MEMORY_MAP_FAILED:
      return "memory could not be mapped";
    case VK_TIMEOUT:
      return "timed out";
    default:
      return "Vulkan result " + std::to_string(static_cast<int>(result));
  }
}

Error failure(std::string_view what, VkResult result) {
  return {ErrorKind::failed, std::string(what) + ": " + describe(result)};
}

}  // namespace gloam::gpu::vulkan
