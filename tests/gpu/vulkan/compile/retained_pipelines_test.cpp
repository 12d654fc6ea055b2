// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/compile/retained_pipelines.h"

#include <gtest/gtest.h>

namespace gloam::gpu::vulkan {
namespace {

/// A pointer that stands for a pipeline; it owns nothing and is never dereferenced.
std::shared_ptr<const PipelineObject> stand_in(std::uintptr_t number) {
  return {std::shared_ptr<const PipelineObject>(), reinterpret_cast<const PipelineObject*>(number * 16)};
}

TEST(RetainedPipelines, gives_back_what_was_kept) {
  RetainedPipelines retained(2);
  EXPECT_EQ(retained.find(7), nullptr);
  retained.keep(7, stand_in(1));
  EXPECT_EQ(retained.find(7), stand_in(1));
  EXPECT_EQ(retained.find(8), nullptr);
}

TEST(RetainedPipelines, the_first_pipeline_of_a_content_stays) {
  RetainedPipelines retained(2);
  retained.keep(7, stand_in(1));
  retained.keep(7, stand_in(2));
  EXPECT_EQ(retained.find(7), stand_in(1));
}

TEST(RetainedPipelines, the_oldest_one_goes_when_there_are_more_than_the_capacity) {
  RetainedPipelines retained(2);
  for (const std::uint64_t content : {1, 2, 3}) retained.keep(content, stand_in(content));
  EXPECT_EQ(retained.find(1), nullptr);
  EXPECT_EQ(retained.find(2), stand_in(2));
  EXPECT_EQ(retained.find(3), stand_in(3));
}

TEST(RetainedPipelines, a_capacity_of_0_keeps_none) {
  RetainedPipelines retained(0);
  EXPECT_FALSE(retained.enabled());
  retained.keep(7, stand_in(1));
  EXPECT_EQ(retained.find(7), nullptr);
}

}  // namespace
}  // namespace gloam::gpu::vulkan
