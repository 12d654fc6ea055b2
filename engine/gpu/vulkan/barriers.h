// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/api.h"

namespace gloam::gpu::vulkan {

/// The Vulkan stages, accesses and image layout of an Access.
struct AccessFacts {
  VkPipelineStageFlags2 stages = 0;
  VkAccessFlags2 access = 0;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};
[[nodiscard]] const AccessFacts& facts_of(Access access);

/// The stages and accesses on one side of a barrier.
struct SyncScope {
  VkPipelineStageFlags2 stages = 0;
  VkAccessFlags2 access = 0;
};
/// The work that a barrier waits for. An empty mask, or one with Access::present, means all earlier work, because the
/// last user of the memory, or the wait for the window, is unknown.
[[nodiscard]] SyncScope source_scope(AccessMask before);
[[nodiscard]] SyncScope target_scope(AccessMask after);

[[nodiscard]] VkImageSubresourceRange to_vulkan(const ImageRange& range, VkImageAspectFlags aspect);
[[nodiscard]] VkBufferMemoryBarrier2 to_vulkan(const BufferBarrier& barrier, VkBuffer buffer);
[[nodiscard]] VkImageMemoryBarrier2 to_vulkan(const ImageBarrier& barrier, VkImage image, VkImageAspectFlags aspect);

}  // namespace gloam::gpu::vulkan
