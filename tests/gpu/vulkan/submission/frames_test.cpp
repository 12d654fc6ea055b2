// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/submission/frames.h"

#include <array>

#include "tests/gpu/vulkan/device_fixture.h"
#include "tests/support/expect_assert.h"

namespace gloam::gpu {
namespace {

class FramesTest : public VulkanTest {
 protected:
  CommandList& begin() {
    const auto commands = device().begin_frame();
    EXPECT_TRUE(commands.ok()) << commands.error().message;
    return **commands;
  }
  void submit() {
    const Status status = device().submit_frame();
    EXPECT_TRUE(status.ok()) << status.error().message;
  }
};

TEST_F(FramesTest, are_numbered_from_zero_and_complete_in_order) {
  EXPECT_EQ(device().frame_number(), 0u);
  EXPECT_EQ(device().completed_frames(), 0u);
  for (std::uint64_t frame = 0; frame < 5; ++frame) {
    (void)begin();
    EXPECT_EQ(device().frame_number(), frame);
    // Beginning frame n waits for frame n - 2.
    EXPECT_GE(device().completed_frames() + 1, frame);
    submit();
    EXPECT_EQ(device().frame_number(), frame + 1);
  }
  ASSERT_TRUE(device().wait_idle().ok());
  EXPECT_EQ(device().completed_frames(), 5u);
}

// Hard case: passes.two_in_flight
TEST_F(FramesTest, two_in_flight_each_see_their_own_data) {
  const BufferHandle counter = test::make_storage(device(), 4);
  std::vector<BufferHandle> results;
  for (std::uint32_t frame = 0; frame < 6; ++frame) {
    CommandList& commands = begin();
    results.push_back(test::make_readback(device(), 4));
    to(commands, counter, Access::none, Access::transfer_write);
    commands.fill_buffer(counter, 0, 4, frame * 11);
    to(commands, counter, Access::transfer_write, Access::transfer_read);
    commands.copy_buffer(counter, 0, results.back(), 0, 4);
    to(commands, results.back(), Access::transfer_write, Access::host_read);
    submit();
  }
  ASSERT_TRUE(device().wait_idle().ok());
  for (std::uint32_t frame = 0; frame < 6; ++frame) {
    EXPECT_EQ(test::items_of<std::uint32_t>(device(), results[frame]).at(0), frame * 11);
  }
}

TEST_F(FramesTest, timestamps_rise_within_a_frame_and_from_frame_to_frame) {
  const BufferHandle buffer = test::make_storage(device(), 1 << 20);
  std::uint64_t last = 0;
  for (std::uint64_t frame = 0; frame < 3; ++frame) {
    test::run_frame(device(), [&](CommandList& commands) {
      commands.write_timestamp(0);
      to(commands, buffer, Access::none, Access::transfer_write);
      commands.fill_buffer(buffer, 0, 1 << 20, 1);
      commands.write_timestamp(3);
    });
    const auto times = device().timestamps(frame);
    ASSERT_EQ(times.size(), 4u);
    EXPECT_GT(times[0], last);
    EXPECT_EQ(times[1], 0u);
    EXPECT_GE(times[3], times[0]);
    last = times[3];
  }
  EXPECT_TRUE(device().timestamps(77).empty());
}

TEST_F(FramesTest, timestamps_of_frames_long_past_are_forgotten) {
  for (int frame = 0; frame < 12; ++frame) {
    test::run_frame(device(), [](CommandList& commands) { commands.write_timestamp(0); });
  }
  EXPECT_TRUE(device().timestamps(0).empty());
  EXPECT_EQ(device().timestamps(10).size(), 1u);
}

TEST_F(FramesTest, a_destroyed_object_lives_until_the_frames_that_may_use_it_have_ended) {
  const BufferHandle buffer = test::make_storage(device(), 1 << 16);
  const std::uint64_t bytes = bytes_of("test");
  CommandList& commands = begin();
  commands.fill_buffer(buffer, 0, 1 << 16, 3);
  device().destroy(buffer);
  EXPECT_EQ(bytes_of("test"), bytes);
  submit();
  ASSERT_TRUE(device().wait_idle().ok());
  EXPECT_EQ(bytes_of("test"), 0u);
}

TEST_F(FramesTest, an_object_that_no_frame_in_flight_can_use_goes_at_once) {
  test::run_frame(device(), [](CommandList&) {});
  const BufferHandle buffer = test::make_storage(device(), 64);
  device().destroy(buffer);
  EXPECT_EQ(bytes_of("test"), 0u);
}

TEST_F(FramesTest, an_abandoned_one_executes_nothing_and_completes_in_order) {
  const BufferHandle words = test::make_storage(device(), 4);
  const ImageHandle picture = test::value_of(device().create_image(
      {.name = "picture",
       .module = "test",
       .format = Format::rgba8_unorm,
       .width = 2,
       .height = 2,
       .usage = ImageUsage::color_target | ImageUsage::transfer_target | ImageUsage::transfer_source}));
  test::run_frame(device(), [&](CommandList& commands) {
    to(commands, words, Access::none, Access::transfer_write);
    commands.fill_buffer(words, 0, 4, 7);
    to(commands, words, Access::transfer_write, Access::transfer_read);
    to(commands, picture, Access::none, Access::transfer_write);
    commands.clear_color_image(picture, {0x3f800000u, 0x3f800000u, 0x3f800000u, 0x3f800000u});
  });
  for (int frame = 0; frame < 3; ++frame) {  // more than there are command buffers
    CommandList& commands = begin();
    commands.begin_label("half recorded");
    commands.write_timestamp(0);
    to(commands, words, Access::transfer_read, Access::transfer_write);
    commands.fill_buffer(words, 0, 4, 8);
    to(commands, picture, Access::transfer_write, Access::color_target);
    RenderingDesc rendering{.width = 2, .height = 2};
    rendering.colors.push_back({.view = {.image = picture}, .load = LoadOp::clear});
    commands.begin_rendering(rendering);
    const std::uint64_t number = device().frame_number();
    ASSERT_TRUE(device().abandon_frame().ok());
    EXPECT_EQ(device().frame_number(), number + 1);
    ASSERT_TRUE(device().wait_frame(number).ok());
    EXPECT_GT(device().completed_frames(), number);
    EXPECT_TRUE(device().timestamps(number).empty());
  }
  BufferHandle texels, copy = test::make_readback(device(), 4);
  test::run_frame(device(), [&](CommandList& commands) {
    texels = read_layer(commands, picture, Access::transfer_write);
    commands.copy_buffer(words, 0, copy, 0, 4);
    to(commands, copy, Access::transfer_write, Access::host_read);
  });
  EXPECT_EQ(test::items_of<std::uint32_t>(device(), copy).at(0), 7u);
  EXPECT_EQ(test::items_of<std::uint32_t>(device(), texels).at(0), 0xffffffffu);
}

TEST_F(FramesTest, can_be_waited_for_one_by_one) {
  (void)begin();
  submit();
  (void)begin();
  submit();
  ASSERT_TRUE(device().wait_frame(0).ok());
  EXPECT_GE(device().completed_frames(), 1u);
  ASSERT_TRUE(device().wait_frame(1).ok());
  EXPECT_EQ(device().completed_frames(), 2u);
  EXPECT_ASSERT((void)device().wait_frame(2), "submitted before it is waited for");
}

TEST_F(FramesTest, misuse_asserts_with_a_sentence) {
  EXPECT_ASSERT((void)device().submit_frame(), "begun before it is submitted");
  CommandList& commands = begin();
  EXPECT_ASSERT((void)device().begin_frame(), "submitted before the next one begins");
  EXPECT_ASSERT(commands.write_timestamp(Device::kTimestampsPerFrame), "kTimestampsPerFrame");
  commands.write_timestamp(1);
  EXPECT_ASSERT(commands.write_timestamp(1), "once a frame");
  submit();
}

}  // namespace
}  // namespace gloam::gpu
