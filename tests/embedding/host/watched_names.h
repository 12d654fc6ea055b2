// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vulkan/vulkan.h>

#include <string>
#include <vector>

namespace host {

/// The host's vkGetInstanceProcAddr, which also notes what gloam creates and names (VK_EXT_debug_utils). For one device
/// of the process.
[[nodiscard]] PFN_vkVoidFunction VKAPI_CALL watching_proc_addr(VkInstance instance, const char* name);

/// What has been noted so far.
struct WatchedNames {
  std::size_t created = 0;           ///< Vulkan objects
  std::vector<std::string> unnamed;  ///< the functions that have created objects without a name
  std::vector<std::string> names;    ///< of objects
  std::vector<std::string> labels;   ///< of groups of commands
};
[[nodiscard]] WatchedNames watched_names();

}  // namespace host
