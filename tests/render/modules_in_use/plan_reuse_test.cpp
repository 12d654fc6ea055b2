// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "engine/frame/frame_graph.h"
#include "engine/gpu/recording/device.h"

namespace gloam {
namespace {

constexpr std::uint32_t kPasses = 100;

/// Declares a chain of compute passes, each of which reads the image of the previous one. The last one is never culled.
void declare(FrameGraph& graph, std::uint32_t passes) {
  ImageRef last;
  for (std::uint32_t i = 0; i < passes; ++i) {
    gpu::ImageDesc desc;
    desc.name = "image " + std::to_string(i);
    desc.module = "test";
    desc.format = gpu::Format::r32_uint;
    desc.width = desc.height = 64;
    const ImageRef image = graph.create_image(desc);
    PassBuilder pass = graph.add_pass("pass " + std::to_string(i), "test");
    if (last) pass.read(last, gpu::Access::compute_read);
    last = pass.write(image, gpu::Access::compute_write);
    if (i + 1 == passes) pass.keep();
    pass.execute([](PassContext&) {});
  }
}

class PlanReuse : public ::testing::Test {
 protected:
  /// Milliseconds for declaring and compiling a frame.
  double frame(std::uint32_t passes) {
    auto commands = device_->begin_frame();
    const auto start = std::chrono::steady_clock::now();
    graph_->begin();
    declare(*graph_, passes);
    EXPECT_TRUE(graph_->compile().ok());
    const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
    graph_->execute(**commands);
    EXPECT_TRUE(device_->submit_frame().ok());
    device_->forget_commands();
    return spent.count();
  }
  void TearDown() override {
    graph_.reset();
    EXPECT_THAT(device_->faults(), ::testing::IsEmpty());
  }

  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
  std::unique_ptr<FrameGraph> graph_ = std::make_unique<FrameGraph>(*device_);
};

TEST_F(PlanReuse, a_hundred_frames_alike_compile_one_plan) {
  const double first = frame(kPasses);
  std::vector<double> rest;
  for (int i = 1; i < 100; ++i) rest.push_back(frame(kPasses));
  EXPECT_EQ(graph_->plans_compiled(), 1u);
  EXPECT_EQ(graph_->pass_times().size(), kPasses);
  std::ranges::sort(rest);
  std::printf("declaration and plan of %u passes: %.3f ms in the first frame, %.3f ms in the median one after\n",
              kPasses, first, rest[rest.size() / 2]);
}

TEST_F(PlanReuse, toggling_between_two_structures_compiles_two_plans) {
  for (int i = 0; i < 100; ++i) frame(i % 2 == 0 ? kPasses : kPasses - 1);
  EXPECT_EQ(graph_->plans_compiled(), 2u);
  EXPECT_LT(graph_->transient_bytes(), graph_->unshared_bytes());
}

TEST_F(PlanReuse, a_structure_that_rests_for_long_is_not_compiled_again) {
  frame(kPasses);
  for (int i = 0; i < 200; ++i) frame(3);
  frame(kPasses);
  EXPECT_EQ(graph_->plans_compiled(), 2u);
}

}  // namespace
}  // namespace gloam
