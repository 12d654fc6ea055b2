// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/pipelines.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "engine/gpu/recording_device.h"
#include "engine/render/draw_pipelines.h"
#include "engine/render/material_packing.h"
#include "shaders/render/draw_shared.h"

namespace gloam {
namespace {

class PipelinesTest : public ::testing::Test {
 protected:
  [[nodiscard]] static gpu::ComputePipelineDesc compute(std::string name, std::string module) {
    gpu::ComputePipelineDesc desc;
    desc.name = std::move(name);
    desc.module = std::move(module);
    return desc;
  }
  void TearDown() override { EXPECT_TRUE(device_->faults().empty()) << device_->faults().front(); }

  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
};

TEST_F(PipelinesTest, a_name_is_made_once) {
  Pipelines pipelines(*device_);
  const auto first = pipelines.get(compute("a", "lights"));
  const auto again = pipelines.get(compute("a", "lights"));
  const auto other = pipelines.get(compute("b", "lights"));
  ASSERT_TRUE(first.ok() && again.ok() && other.ok());
  EXPECT_EQ(*first, *again);
  EXPECT_NE(*first, *other);
  EXPECT_EQ(device_->pipeline_count("lights"), 2u);
  EXPECT_EQ(pipelines.find("a"), *first);
  EXPECT_FALSE(pipelines.find("c"));
}

TEST_F(PipelinesTest, release_takes_one_modules_pipelines_only) {
  Pipelines pipelines(*device_);
  ASSERT_TRUE(pipelines.get(compute("a", "lights")).ok());
  ASSERT_TRUE(pipelines.get(compute("b", "grass")).ok());
  ASSERT_TRUE(pipelines.get(compute("c", "lights")).ok());
  pipelines.release("lights");
  EXPECT_EQ(device_->pipeline_count("lights"), 0u);
  EXPECT_EQ(device_->pipeline_count("grass"), 1u);
  EXPECT_FALSE(pipelines.find("a"));
  EXPECT_TRUE(pipelines.find("b"));
  ASSERT_TRUE(pipelines.get(compute("a", "lights")).ok());
  EXPECT_EQ(device_->pipeline_count("lights"), 1u);
}

TEST_F(PipelinesTest, leave_nothing_behind) {
  {
    Pipelines pipelines(*device_);
    ASSERT_TRUE(pipelines.get(compute("a", "lights")).ok());
  }
  EXPECT_EQ(device_->pipeline_count("lights"), 0u);
}

TEST_F(PipelinesTest, a_failed_creation_reaches_the_caller_and_is_tried_again) {
  Pipelines pipelines(*device_);
  device_->fail_next_creation({ErrorKind::failed, "no memory for pipeline a"});
  const auto refused = pipelines.get(compute("a", "lights"));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message, "no memory for pipeline a");
  EXPECT_FALSE(pipelines.find("a"));
  EXPECT_TRUE(pipelines.get(compute("a", "lights")).ok());
}

TEST_F(PipelinesTest, threads_that_race_for_a_name_get_the_same_one) {
  Pipelines pipelines(*device_);
  std::vector<gpu::PipelineHandle> got(8);
  std::vector<std::thread> threads;
  for (gpu::PipelineHandle& handle : got) {
    threads.emplace_back([&] {
      auto made = pipelines.get(compute("a", "lights"));
      if (made.ok()) handle = *made;
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const gpu::PipelineHandle& handle : got) EXPECT_EQ(handle, got.front());
  EXPECT_TRUE(got.front());
  EXPECT_EQ(device_->pipeline_count("lights"), 1u);
}

TEST_F(PipelinesTest, every_surface_variant_has_a_name_of_its_own) {
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
