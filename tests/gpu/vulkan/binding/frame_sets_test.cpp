// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/binding/frame_sets.h"

#include <array>

#include "engine/gpu/vulkan/device.h"
#include "shaders/gpu_test/shaders.h"
#include "tests/gpu/vulkan/device_fixture.h"

namespace gloam::gpu {
namespace {

/// A device without push descriptors.
class FrameSets : public VulkanTest {
 protected:
  static constexpr std::uint32_t kDispatches = 2 * vulkan::FrameSets::kSetsPerPool + 7;

  void SetUp() override {
    VulkanOptions options = test::test_device_options();
    options.push_descriptors = PushDescriptors::never;
    device_ = test::make_test_device(true, options);
    GLOAM_REQUIRE_GPU(device_);
    pipeline_ = test::value_of(device().create_pipeline(
        ComputePipelineDesc{.name = "double", .module = "test", .shader = shaders::gpu_test::double_numbers_comp}));
    source_ = test::make_upload(device(), std::vector<std::uint32_t>{21});
    uniform_ = test::make_upload(device(), std::vector<std::uint32_t>(kDispatches * kUniformWords, 0));
    for (std::uint32_t i = 0; i < kDispatches; ++i) {
      reinterpret_cast<std::uint32_t*>(device().mapped(uniform_).data())[i * kUniformWords] = i;
    }
    target_ = test::make_storage(device(), kDispatches * kStride);
    read_ = test::make_readback(device(), kDispatches * kStride);
  }

  [[nodiscard]] std::size_t pools() { return dynamic_cast<vulkan::VulkanDevice&>(device()).frame_sets().pool_count(); }

  /// Each dispatch binds its own ranges: it writes 42 plus its own number to its own place.
  void record(CommandList& commands) {
    commands.fill_buffer(target_, 0, kDispatches * kStride, 7);
    to(commands, target_, Access::transfer_write, Access::compute_write);
    commands.bind_pipeline(pipeline_);
    for (std::uint64_t i = 0; i < kDispatches; ++i) {
      commands.bind(std::array{Binding{0, Binding::BufferRange{source_}},
                               Binding{1, Binding::BufferRange{target_, i * kStride, 4}},
                               Binding{2, Binding::BufferRange{uniform_, i * kUniformWords * 4, 4}}});
      commands.push(std::uint32_t{1});
      commands.dispatch(1, 1, 1);
    }
    to(commands, target_, Access::compute_write, Access::transfer_read);
    commands.copy_buffer(target_, 0, read_, 0, kDispatches * kStride);
    to(commands, read_, Access::transfer_write, Access::host_read);
  }
  [[nodiscard]] bool all_as_bound() {
    const auto words = test::items_of<std::uint32_t>(device(), read_);
    for (std::uint32_t i = 0; i < kDispatches; ++i) {
      if (words[i * kStride / 4] != 42 + i) return false;
    }
    return true;
  }

  static constexpr std::uint32_t kStride = 256;  // bytes; a multiple of every device's offset alignment
  static constexpr std::uint32_t kUniformWords = kStride / 4;
  PipelineHandle pipeline_;
  BufferHandle source_, uniform_, target_, read_;
};

TEST_F(FrameSets, keep_the_resources_of_every_bind_of_a_frame) {
  test::run_frame(device(), [&](CommandList& commands) { record(commands); });
  EXPECT_TRUE(all_as_bound());
  EXPECT_EQ(pools(), 3u);
}

TEST_F(FrameSets, are_allocated_again_when_the_frame_in_flight_returns) {
  for (std::uint32_t frame = 0; frame < 3 * Device::kFramesInFlight; ++frame) {
    const auto commands = device().begin_frame();
    ASSERT_TRUE(commands.ok()) << commands.error().message;
    record(**commands);
    // Frames write to the same buffers, so the next one waits on the GPU.
    to(**commands, target_, Access::transfer_read, Access::transfer_write);
    to(**commands, read_, Access::host_read, Access::transfer_write);
    ASSERT_TRUE(device().submit_frame().ok());
  }
  ASSERT_TRUE(device().wait_idle().ok());
  EXPECT_TRUE(all_as_bound());
  EXPECT_EQ(pools(), 3u * Device::kFramesInFlight);
}

}  // namespace
}  // namespace gloam::gpu
