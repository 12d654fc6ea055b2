// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/pipelines/pipelines.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "engine/gpu/recording/device.h"
#include "engine/render/scene/draw_pipelines.h"
#include "engine/render/scene/material_packing.h"
#include "shaders/render/draw_shared.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

class PipelinesTest : public ::testing::Test {
 protected:
  /// Descriptions with different numbers differ in a constant.
  [[nodiscard]] static gpu::ComputePipelineDesc compute(std::uint32_t number, std::string module) {
    gpu::ComputePipelineDesc desc;
    desc.module = std::move(module);
    desc.constants = {{"kScale", number}};
    return desc;
  }
  void TearDown() override { EXPECT_TRUE(device_->faults().empty()) << device_->faults().front(); }

  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
};

TEST_F(PipelinesTest, a_description_is_made_once_whatever_its_name) {
  Pipelines pipelines(*device_);
  const auto first = pipelines.get(compute(1, "lights"));
  auto renamed = compute(1, "lights");
  renamed.name = "another name";
  const auto again = pipelines.get(renamed);
  const auto other = pipelines.get(compute(2, "lights"));
  ASSERT_TRUE(first.ok() && again.ok() && other.ok());
  EXPECT_EQ(*first, *again);
  EXPECT_NE(*first, *other);
  EXPECT_EQ(device_->pipeline_count("lights"), 2u);
  EXPECT_EQ(pipelines.find(compute(1, "lights")), *first);
  EXPECT_FALSE(pipelines.find(compute(3, "lights")));
}

TEST_F(PipelinesTest, of_no_frame_for_a_long_time_are_destroyed_and_made_again) {
  Pipelines pipelines(*device_);
  const auto old = pipelines.get(compute(1, "lights"));
  const auto used = pipelines.get(compute(2, "lights"));
  ASSERT_TRUE(old.ok() && used.ok());
  for (std::uint64_t frame = 0; frame < Pipelines::kUnusedFrames; ++frame) {
    pipelines.begin_frame();
    EXPECT_EQ(pipelines.find(compute(2, "lights")), *used);
  }
  pipelines.release_unused();
  EXPECT_EQ(device_->pipeline_count("lights"), 2u) << "not for long enough";
  pipelines.begin_frame();
  EXPECT_TRUE(pipelines.request({compute(2, "lights")}, null_log()));
  pipelines.release_unused();
  EXPECT_EQ(device_->pipeline_count("lights"), 1u);
  EXPECT_FALSE(pipelines.find(compute(1, "lights")));
  EXPECT_TRUE(pipelines.get(compute(1, "lights")).ok());
  EXPECT_EQ(device_->pipeline_count("lights"), 2u);
}

TEST_F(PipelinesTest, modules_do_not_share_pipelines) {
  Pipelines pipelines(*device_);
  const auto lights = pipelines.get(compute(1, "lights"));
  const auto grass = pipelines.get(compute(1, "grass"));
  ASSERT_TRUE(lights.ok() && grass.ok());
  EXPECT_NE(*lights, *grass);
}

TEST_F(PipelinesTest, a_compute_and_a_graphics_pipeline_of_equal_fields_are_two) {
  Pipelines pipelines(*device_);
  gpu::GraphicsPipelineDesc drawn;
  drawn.module = "lights";
  gpu::ComputePipelineDesc computed;
  computed.module = "lights";
  const auto first = pipelines.get(drawn);
  const auto second = pipelines.get(computed);
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_NE(*first, *second);
}

TEST_F(PipelinesTest, release_takes_one_modules_pipelines_only) {
  Pipelines pipelines(*device_);
  ASSERT_TRUE(pipelines.get(compute(1, "lights")).ok());
  ASSERT_TRUE(pipelines.get(compute(2, "grass")).ok());
  ASSERT_TRUE(pipelines.get(compute(3, "lights")).ok());
  pipelines.release("lights");
  EXPECT_EQ(device_->pipeline_count("lights"), 0u);
  EXPECT_EQ(device_->pipeline_count("grass"), 1u);
  EXPECT_FALSE(pipelines.find(compute(1, "lights")));
  EXPECT_TRUE(pipelines.find(compute(2, "grass")));
  ASSERT_TRUE(pipelines.get(compute(1, "lights")).ok());
  EXPECT_EQ(device_->pipeline_count("lights"), 1u);
}

TEST_F(PipelinesTest, leave_nothing_behind) {
  {
    Pipelines pipelines(*device_);
    ASSERT_TRUE(pipelines.get(compute(1, "lights")).ok());
  }
  EXPECT_EQ(device_->pipeline_count("lights"), 0u);
}

TEST_F(PipelinesTest, a_failed_creation_reaches_the_caller_and_is_tried_again) {
  Pipelines pipelines(*device_);
  device_->fail_next_creation({ErrorKind::failed, "no memory for pipeline a"});
  const auto refused = pipelines.get(compute(1, "lights"));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message, "no memory for pipeline a");
  EXPECT_FALSE(pipelines.find(compute(1, "lights")));
  EXPECT_TRUE(pipelines.get(compute(1, "lights")).ok());
}

TEST_F(PipelinesTest, threads_that_race_for_a_description_get_the_same_pipeline) {
  Pipelines pipelines(*device_);
  std::vector<gpu::PipelineHandle> got(8);
  std::vector<std::thread> threads;
  for (gpu::PipelineHandle& handle : got) {
    threads.emplace_back([&] {
      auto made = pipelines.get(compute(1, "lights"));
      if (made.ok()) handle = *made;
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const gpu::PipelineHandle& handle : got) EXPECT_EQ(handle, got.front());
  EXPECT_TRUE(got.front());
  EXPECT_EQ(device_->pipeline_count("lights"), 1u);
}

TEST_F(PipelinesTest, every_surface_variant_is_a_pipeline_of_its_own) {
  Pipelines pipelines(*device_);
  std::set<gpu::PipelineHandle> made;
  for (const std::uint32_t features :
       {0u, GLOAM_SURFACE_MASK, GLOAM_SURFACE_BASE_TEXTURE | GLOAM_SURFACE_VERTEX_COLOR}) {
    for (const gpu::CullMode cull : {gpu::CullMode::none, gpu::CullMode::front, gpu::CullMode::back}) {
      const auto pipeline = surface_pipeline(pipelines, geometry_surface_pass(), {features, cull});
      ASSERT_TRUE(pipeline.ok());
      EXPECT_TRUE(made.insert(*pipeline).second);
      EXPECT_EQ(*surface_pipeline(pipelines, geometry_surface_pass(), {features, cull}), *pipeline);
    }
  }
  EXPECT_EQ(device_->pipeline_count("engine"), 9u);
}

}  // namespace
}  // namespace gloam
