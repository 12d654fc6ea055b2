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
#include "engine/render/scene/draw_pipelines.h"
#include "engine/render/scene/material_packing.h"
#include "shaders/render/draw_shared.h"
#include "tests/support/expect_assert.h"

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

TEST_F(PipelinesTest, a_name_stands_for_one_compute_description) {
  Pipelines pipelines(*device_);
  gpu::ComputePipelineDesc desc = compute("a", "lights");
  desc.constants = {{0, 4}, {1, 7}};
  ASSERT_TRUE(pipelines.get(desc).ok());
  EXPECT_TRUE(pipelines.get(gpu::ComputePipelineDesc(desc)).ok());
  const auto refused = [&](const gpu::ComputePipelineDesc& other) {
    EXPECT_ASSERT((void)pipelines.get(other), "pipeline a was made from another description");
  };
  auto other = desc;
  other.constants[1].value = 8;
  refused(other);
  other = desc;
  other.constants.pop_back();
  refused(other);
  other = desc;
  other.module = "grass";
  refused(other);
  other = desc;
  const std::uint32_t words[] = {1, 2, 3};
  other.shader.words = words;
  refused(other);
  gpu::GraphicsPipelineDesc drawn;
  drawn.name = "a";
  drawn.module = "lights";
  EXPECT_ASSERT((void)pipelines.get(drawn), "another description");
  pipelines.release("lights");
  EXPECT_TRUE(pipelines.get(other).ok()) << "a released name is free again";
}

TEST_F(PipelinesTest, a_name_stands_for_one_graphics_description) {
  Pipelines pipelines(*device_);
  gpu::GraphicsPipelineDesc desc;
  desc.name = "a";
  desc.module = "lights";
  desc.color_formats = {gpu::Format::rgba16_float};
  desc.attributes = {{0, 0, gpu::Format::rgba32_float, 0}};
  desc.stream_strides = {16};
  ASSERT_TRUE(pipelines.get(desc).ok());
  EXPECT_TRUE(pipelines.get(gpu::GraphicsPipelineDesc(desc)).ok());
  const auto refused = [&](auto change) {
    gpu::GraphicsPipelineDesc other = desc;
    change(other);
    EXPECT_ASSERT((void)pipelines.get(other), "another description");
  };
  refused([](auto& d) { d.color_formats[0] = gpu::Format::rgba8_srgb; });
  refused([](auto& d) { d.color_formats.clear(); });
  refused([](auto& d) { d.depth_format = gpu::Format::d32_float; });
  refused([](auto& d) { d.constants = {{0, 1}}; });
  refused([](auto& d) { d.attributes[0].offset = 4; });
  refused([](auto& d) { d.stream_strides[0] = 20; });
  refused([](auto& d) { d.cull = gpu::CullMode::front; });
  refused([](auto& d) { d.blend = gpu::BlendMode::additive; });
  refused([](auto& d) { d.depth_compare = gpu::CompareOp::equal; });
  refused([](auto& d) { d.depth_write = false; });
  refused([](auto& d) { d.depth_bias = true; });
  refused([](auto& d) { d.vertex.name = "other"; });
  refused([](auto& d) { d.fragment.name = "other"; });
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
