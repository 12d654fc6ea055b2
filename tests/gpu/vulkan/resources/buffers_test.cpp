// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/resources/buffers.h"

#include <numeric>

#include "tests/gpu/vulkan/device_fixture.h"
#include "tests/support/expect_assert.h"

namespace gloam::gpu {
namespace {

class Buffers : public VulkanTest {};

TEST_F(Buffers, bytes_survive_the_way_to_the_device_and_back) {
  std::vector<std::uint32_t> numbers(5000);
  std::iota(numbers.begin(), numbers.end(), 17u);
  const BufferHandle upload = test::make_upload(device(), numbers);
  const BufferHandle storage = test::make_storage(device(), numbers.size() * 4);
  const BufferHandle readback = test::make_readback(device(), numbers.size() * 4);
  test::run_frame(device(), [&](CommandList& commands) {
    commands.copy_buffer(upload, 0, storage, 0, numbers.size() * 4);
    to(commands, storage, Access::transfer_write, Access::transfer_read);
    commands.copy_buffer(storage, 0, readback, 0, numbers.size() * 4);
    to(commands, readback, Access::transfer_write, Access::host_read);
  });
  EXPECT_EQ(test::items_of<std::uint32_t>(device(), readback), numbers);
}

TEST_F(Buffers, copies_and_fills_touch_only_their_range) {
  const BufferHandle upload = test::make_upload(device(), std::vector<std::uint32_t>{1, 2, 3, 4});
  const BufferHandle readback = test::make_readback(device(), 24);
  test::run_frame(device(), [&](CommandList& commands) {
    commands.fill_buffer(readback, 0, 24, 9);
    to(commands, readback, Access::transfer_write, Access::transfer_write);
    commands.copy_buffer(upload, 4, readback, 8, 8);
    to(commands, readback, Access::transfer_write, Access::host_read);
  });
  EXPECT_EQ(test::items_of<std::uint32_t>(device(), readback), (std::vector<std::uint32_t>{9, 9, 2, 3, 9, 9}));
}

TEST_F(Buffers, descriptions_stay_readable) {
  const BufferHandle buffer = test::make_storage(device(), 64);
  EXPECT_EQ(device().desc(buffer).size, 64u);
  EXPECT_EQ(device().desc(buffer).module, "test");
}

TEST_F(Buffers, misuse_asserts_with_a_sentence) {
  const BufferHandle storage = test::make_storage(device(), 64);
  const BufferHandle upload = test::make_upload(device(), std::vector<std::uint32_t>{1, 2});
  EXPECT_ASSERT((void)device().mapped(storage), "only upload and readback buffers are mapped");
  EXPECT_ASSERT((void)device().create_buffer({.name = "empty", .usage = BufferUsage::storage}), "at least one byte");
  test::run_frame(device(), [&](CommandList& commands) {
    EXPECT_ASSERT(commands.copy_buffer(upload, 4, storage, 0, 8), "stays inside buffer \"test upload\"");
    EXPECT_ASSERT(commands.fill_buffer(storage, 0, 6, 0), "whole words");
  });
  device().destroy(storage);
  EXPECT_ASSERT((void)device().desc(storage), "alive");
}

TEST_F(Buffers, a_buffer_that_is_too_large_is_an_error_that_names_it) {
  const auto buffer =
      device().create_buffer({.name = "giant", .module = "test", .size = 1ull << 62, .usage = BufferUsage::storage});
  ASSERT_FALSE(buffer.ok());
  EXPECT_EQ(buffer.error().kind, ErrorKind::failed);
  EXPECT_NE(buffer.error().message.find("\"giant\" of module \"test\""), std::string::npos) << buffer.error().message;
}

}  // namespace
}  // namespace gloam::gpu
