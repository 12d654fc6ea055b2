// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/barriers.h"

#include <array>

#include "engine/core/assert.h"
#include "engine/gpu/access.h"

namespace gloam::gpu::vulkan {
namespace {

constexpr VkPipelineStageFlags2 kVertex = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
constexpr VkPipelineStageFlags2 kFragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kDepth =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
constexpr VkAccessFlags2 kShaderRead = VK_ACCESS_2_SHADER_READ_BIT;
constexpr VkAccessFlags2 kShaderReadWrite = VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;

// READ_ONLY_OPTIMAL allows both sampling and depth testing, so one pass may test and sample a depth image.
constexpr VkImageLayout kReadOnly = VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL;
constexpr VkImageLayout kTarget = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
constexpr VkImageLayout kGeneral = VK_IMAGE_LAYOUT_GENERAL;

// In the order of Access.
constexpr std::array<AccessFacts, 17> kFacts = {{
    /* none */ {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_UNDEFINED},
    /* transfer_read */
    {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL},
    /* transfer_write */
    {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL},
    /* host_read */ {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT, kGeneral},
    /* vertex_input */
    {VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT, VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT,
     kGeneral},
    /* indirect_read */
    {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, kGeneral},
    /* uniform_read */ {kVertex | kFragment | kCompute, kShaderRead, kReadOnly},
    /* vertex_read */ {kVertex, kShaderRead, kReadOnly},
    /* fragment_read */ {kFragment, kShaderRead, kReadOnly},
    /* compute_read */ {kCompute, kShaderRead, kReadOnly},
    /* compute_storage_read */ {kCompute, kShaderRead, kGeneral},
    /* compute_write */ {kCompute, kShaderReadWrite, kGeneral},
    /* fragment_write */ {kFragment, kShaderReadWrite, kGeneral},
    /* color_target */
    {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
     VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, kTarget},
    /* depth_target */
    {kDepth, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, kTarget},
    /* depth_test */
    {kDepth | kFragment, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | kShaderRead, kReadOnly},
    /* present */ {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR},
}};
static_assert(kFacts.size() == static_cast<std::size_t>(Access::present) + 1);

}  // namespace

const AccessFacts& facts_of(Access access) {
  const auto index = static_cast<std::size_t>(access);
  GLOAM_ASSERT(index < kFacts.size(), "an access must be one of the enumeration");
  return kFacts[index];
}

SyncScope source_scope(AccessMask before) {
  if (before == 0 || (before & mask_of(Access::present)) != 0) {
    return {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT};
  }
  SyncScope scope;
  for_each_access(before, [&](Access access) {
    const AccessFacts& facts = facts_of(access);
    scope.stages |= facts.stages;
    // A read needs only an execution dependency; there is nothing to flush.
    if (is_write(access)) scope.access |= facts.access;
  });
  return scope;
}

SyncScope target_scope(AccessMask after) {
  SyncScope scope;
  for_each_access(after, [&](Access access) {
    scope.stages |= facts_of(access).stages;
    scope.access |= facts_of(access).access;
  });
  return scope;
}

VkImageSubresourceRange to_vulkan(const ImageRange& range, VkImageAspectFlags aspect) {
  return {aspect, range.first_mip, range.mip_count == 0 ? VK_REMAINING_MIP_LEVELS : range.mip_count, range.first_layer,
          range.layer_count == 0 ? VK_REMAINING_ARRAY_LAYERS : range.layer_count};
}

VkBufferMemoryBarrier2 to_vulkan(const BufferBarrier& barrier, VkBuffer buffer) {
  const SyncScope before = source_scope(mask_of(barrier.before) | barrier.also_before);
  const SyncScope after = target_scope(mask_of(barrier.after) | barrier.also_after);
  return {.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2,
          .srcStageMask = before.stages,
          .srcAccessMask = before.access,
          .dstStageMask = after.stages,
          .dstAccessMask = after.access,
          .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
          .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
          .buffer = buffer,
          .offset = 0,
          .size = VK_WHOLE_SIZE};
}

VkImageMemoryBarrier2 to_vulkan(const ImageBarrier& barrier, VkImage image, VkImageAspectFlags aspect) {
  GLOAM_ASSERT(fits_image(barrier.after), "an image barrier must lead to an access that images can have");
  const SyncScope before = source_scope(mask_of(barrier.before) | barrier.also_before);
  const SyncScope after = target_scope(mask_of(barrier.after) | barrier.also_after);
  return {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
          .srcStageMask = before.stages,
          .srcAccessMask = before.access,
          .dstStageMask = after.stages,
          .dstAccessMask = after.access,
          .oldLayout = facts_of(barrier.before).layout,
          .newLayout = facts_of(barrier.after).layout,
          .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
          .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
          .image = image,
          .subresourceRange = to_vulkan(barrier.range, aspect)};
}

}  // namespace gloam::gpu::vulkan
