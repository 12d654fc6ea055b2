// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/barriers.h"

#include <gtest/gtest.h>

#include "tests/support/expect_assert.h"

namespace gloam::gpu::vulkan {
namespace {

TEST(Barriers, a_read_waits_for_execution_only) {
  const SyncScope scope = source_scope(mask_of(Access::compute_read));
  EXPECT_EQ(scope.stages, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
  EXPECT_EQ(scope.access, VK_ACCESS_2_NONE);
}

TEST(Barriers, a_write_is_flushed_from_its_stage) {
  const SyncScope scope = source_scope(mask_of(Access::color_target));
  EXPECT_EQ(scope.stages, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT);
  EXPECT_NE(scope.access & VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, 0u);
}

TEST(Barriers, an_unknown_past_waits_for_everything) {
  for (const AccessMask before : {AccessMask{0}, mask_of(Access::present)}) {
    EXPECT_EQ(source_scope(before).stages, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
    EXPECT_EQ(source_scope(before).access, VK_ACCESS_2_MEMORY_WRITE_BIT);
  }
}

TEST(Barriers, several_accesses_on_either_side_are_joined) {
  const auto barrier = to_vulkan(BufferBarrier{.before = Access::compute_write,
                                               .after = Access::indirect_read,
                                               .also_before = mask_of(Access::vertex_read),
                                               .also_after = mask_of(Access::fragment_read)},
                                 VK_NULL_HANDLE);
  EXPECT_EQ(barrier.srcStageMask, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT);
  EXPECT_EQ(barrier.dstStageMask, VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT);
  EXPECT_EQ(barrier.dstAccessMask, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_SHADER_READ_BIT);
}

TEST(Barriers, contents_are_thrown_away_exactly_when_there_is_no_access_before) {
  const auto fresh = to_vulkan(ImageBarrier{.after = Access::compute_write, .also_before = mask_of(Access::depth_test)},
                               VK_NULL_HANDLE, VK_IMAGE_ASPECT_COLOR_BIT);
  EXPECT_EQ(fresh.oldLayout, VK_IMAGE_LAYOUT_UNDEFINED);
  EXPECT_EQ(fresh.newLayout, VK_IMAGE_LAYOUT_GENERAL);
  EXPECT_EQ(fresh.srcStageMask & VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0u);
  const auto kept = to_vulkan(ImageBarrier{.before = Access::compute_write, .after = Access::fragment_read},
                              VK_NULL_HANDLE, VK_IMAGE_ASPECT_COLOR_BIT);
  EXPECT_EQ(kept.oldLayout, VK_IMAGE_LAYOUT_GENERAL);
  EXPECT_EQ(kept.newLayout, VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL);
}

TEST(Barriers, an_image_barrier_leads_to_an_access_that_images_can_have) {
  EXPECT_ASSERT((void)to_vulkan(ImageBarrier{.after = Access::vertex_input}, VK_NULL_HANDLE, VK_IMAGE_ASPECT_COLOR_BIT),
                "must lead to an access");
}

}  // namespace
}  // namespace gloam::gpu::vulkan
