// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/gpu/vulkan/api.h"

namespace gloam::gpu::vulkan {

/// Fills `items` by a function of Vulkan that lists: list(&count, items or null) returns a VkResult. Returns VK_SUCCESS
/// or an error, and then no items.
template <class Item, class List>
[[nodiscard]] VkResult list_all(std::vector<Item>& items, const List& list) {
  VkResult result = VK_INCOMPLETE;  // the list has grown between the two calls
  while (result == VK_INCOMPLETE) {
    std::uint32_t count = 0;
    result = list(&count, static_cast<Item*>(nullptr));
    if (result != VK_SUCCESS && result != VK_INCOMPLETE) break;
    items.resize(count);
    if (count == 0) return VK_SUCCESS;  // without a place for items, the second call would count again
    result = list(&count, items.data());
    if (result == VK_SUCCESS) items.resize(count);
  }
  if (result != VK_SUCCESS) items.clear();
  return result;
}

}  // namespace gloam::gpu::vulkan
