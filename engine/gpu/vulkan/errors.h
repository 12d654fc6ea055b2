// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/gpu/vulkan/api.h"

namespace gloam::gpu::vulkan {

/// Describes a result: "out of device memory", "the device was lost", …
[[nodiscard]] std::string describe(VkResult result);

/// ErrorKind::failed with the message "<what>: <describe(result)>". `what`: the action that failed.
[[nodiscard]] Error failure(std::string_view what, VkResult result);

/// For handles that are destroyed later in any case: makes a handle null if its creation has failed, because Vulkan
/// leaves it undefined. Returns `result`.
template <class Handle>
[[nodiscard]] VkResult null_on_failure(VkResult result, Handle& handle) {
  if (result != VK_SUCCESS) handle = VK_NULL_HANDLE;
  return result;
}

}  // namespace gloam::gpu::vulkan
