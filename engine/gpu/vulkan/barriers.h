// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/api.h"

namespace gloam::gpu::vulkan {

/// What an Access means to Vulkan.
struct AccessFacts {
  VkPipelineStageFlags2 stages = 0;
  VkAccessFlags2 access = 0;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};
[[nodiscard]] const AccessFacts& facts_of(Access access);

/// One side of a barrier.
struct SyncScope {
  VkPipelineStageFlags2 stages = 0;
  VkAccessFlags2 access = 0;
};
/// What must end before the barrier. An empty mask, or one with Access::present, means all earlier work: what used the
/// memory, or waits for the window, is not known.
[[nodiscard]] SyncScope source_scope(AccessMask before);
[[nodiscard]] SyncScope target_scope(AccessMask after);

[[nodiscard]] VkBufferMemoryBarrier2 to_vulkan(const BufferBarrier& barrier, VkBuffer buffer);
/// All mips and layers.
[[nodiscard]] VkImageMemoryBarrier2 to_vulkan(const ImageBarrier& barrier, VkImage image, VkImageAspectFlags aspect);

}  // namespace gloam::gpu::vulkan
