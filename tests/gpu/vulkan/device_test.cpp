// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan_device.h"

#include <atomic>
#include <string>

#include "tests/gpu/vulkan/device_fixture.h"

namespace gloam::gpu {
namespace {

class VulkanDevice : public VulkanTest {};

TEST_F(VulkanDevice, says_what_it_is) {
  const DeviceInfo& info = device().info();
  EXPECT_FALSE(info.name.empty());
  EXPECT_FALSE(info.driver.empty());
  EXPECT_GE(info.subgroup_size, 4u);
  EXPECT_GE(info.max_storage_range, 128ull << 20);
}

TEST_F(VulkanDevice, is_found_by_part_of_its_name_in_any_case) {
  std::string part = device().info().name.substr(1, 5);
  for (char& c : part) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  const auto same = create_vulkan_device({.device = part});
  ASSERT_TRUE(same.ok()) << same.error().message;
  EXPECT_EQ((*same)->info().name, device().info().name);
}

TEST_F(VulkanDevice, is_found_by_type) {
  const bool cpu = device().info().type == DeviceType::cpu;
  const auto same = create_vulkan_device({.device = cpu ? "cpu" : "gpu"});
  ASSERT_TRUE(same.ok()) << same.error().message;
  EXPECT_EQ((*same)->info().type == DeviceType::cpu, cpu);
}

TEST_F(VulkanDevice, a_wish_that_nothing_fits_names_what_there_is) {
  const auto none = create_vulkan_device({.device = "Voodoo 2"});
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().kind, ErrorKind::no_device);
  EXPECT_NE(none.error().message.find("\"Voodoo 2\""), std::string::npos) << none.error().message;
  EXPECT_NE(none.error().message.find(device().info().name), std::string::npos) << none.error().message;
}

TEST_F(VulkanDevice, two_live_in_one_process) {
  const auto other = test::make_test_device(false);
  ASSERT_NE(other, nullptr);
  const BufferHandle mine = test::make_readback(device(), 4);
  const BufferHandle theirs = test::make_readback(*other, 4);
  const auto fill = [](Device& d, BufferHandle buffer, std::uint32_t word) {
    test::run_frame(d, [&](CommandList& commands) {
      commands.begin_label("fill");
      commands.fill_buffer(buffer, 0, 4, word);
      to(commands, buffer, Access::transfer_write, Access::host_read);
      commands.end_label();
    });
  };
  fill(device(), mine, 1);
  fill(*other, theirs, 2);
  fill(device(), mine, 3);
  EXPECT_EQ(test::items_of<std::uint32_t>(device(), mine).at(0), 3u);
  EXPECT_EQ(test::items_of<std::uint32_t>(*other, theirs).at(0), 2u);
}

TEST_F(VulkanDevice, equal_samplers_are_one) {
  const auto a = test::value_of(device().create_sampler({.max_anisotropy = 8.0f}));
  EXPECT_EQ(a, test::value_of(device().create_sampler({.max_anisotropy = 8.0f})));
  EXPECT_NE(a, test::value_of(device().create_sampler({.compare = true})));
}

TEST_F(VulkanDevice, closes_silently_with_objects_still_alive_and_a_frame_in_flight) {
  std::atomic<int> messages = 0;
  FunctionLog log([&](LogLevel level, std::string_view) { messages += level >= LogLevel::warning ? 1 : 0; });
  auto other = create_vulkan_device({.validate = true, .log = &log});
  if (!other) GTEST_SKIP() << other.error().message;
  const BufferHandle buffer = test::make_storage(**other, 1 << 20);
  (void)test::value_of((*other)->create_image(
      {.name = "left alone", .module = "test", .format = Format::rgba8_unorm, .usage = ImageUsage::sampled}));
  const auto commands = (*other)->begin_frame();
  ASSERT_TRUE(commands.ok());
  (*commands)->fill_buffer(buffer, 0, 1 << 20, 1);
  ASSERT_TRUE((*other)->submit_frame().ok());
  (*other)->destroy(buffer);
  other->reset();
  EXPECT_EQ(messages, 0);
}

TEST_F(VulkanDevice, validation_messages_are_counted) {
  auto other = create_vulkan_device({.validate = true});
  if (!other) GTEST_SKIP() << other.error().message;
  const BufferHandle buffer = test::make_readback(**other, 64);
  const auto commands = (*other)->begin_frame();
  ASSERT_TRUE(commands.ok());
  (*commands)->fill_buffer(buffer, 0, 64, 1);
  (*commands)->fill_buffer(buffer, 0, 64, 2);  // no barrier in between: synchronization validation must report it
  ASSERT_TRUE((*other)->submit_frame().ok());
  EXPECT_GT((*other)->validation_messages(), 0u);
}

}  // namespace
}  // namespace gloam::gpu
