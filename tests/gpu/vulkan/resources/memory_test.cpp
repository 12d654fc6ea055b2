// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/resources/memory.h"

#include <algorithm>
#include <array>
#include <random>

#include "tests/gpu/vulkan/device_fixture.h"
#include "tests/support/expect_assert.h"

namespace gloam::gpu {
namespace {

class Memory : public VulkanTest {
 protected:
  BufferHandle make(std::string module, std::uint64_t bytes, MemoryKind kind = MemoryKind::device) {
    return test::value_of(device().create_buffer({.name = "bytes",
                                                  .module = std::move(module),
                                                  .size = bytes,
                                                  .usage = BufferUsage::storage | BufferUsage::transfer_target,
                                                  .memory = kind}));
  }
};

TEST_F(Memory, is_counted_by_module_in_order_and_returns_to_nothing) {
  EXPECT_TRUE(device().memory().empty());
  const BufferHandle b = make("beta", 1000);
  const BufferHandle a = make("alpha", 5000, MemoryKind::upload);
  const BufferHandle c = make("beta", 70000, MemoryKind::readback);
  const auto usage = device().memory();
  ASSERT_EQ(usage.size(), 2u);
  EXPECT_EQ(usage[0].module, "alpha");
  EXPECT_GE(usage[0].bytes, 5000u);
  EXPECT_LT(usage[0].bytes, 10000u);
  EXPECT_EQ(usage[1].module, "beta");
  EXPECT_GE(usage[1].bytes, 71000u);
  for (const BufferHandle buffer : {a, b, c}) device().destroy(buffer);
  EXPECT_TRUE(device().memory().empty());
}

TEST_F(Memory, objects_larger_than_half_a_block_work_too) {
  constexpr std::uint64_t kLarge = (MemoryOptions{}.block_bytes / 2) + 4096;
  const BufferHandle large = make("test", kLarge, MemoryKind::readback);
  test::run_frame(device(), [&](CommandList& commands) {
    commands.fill_buffer(large, kLarge - 8, 8, 0xabcdu);
    to(commands, large, Access::transfer_write, Access::host_read);
  });
  std::uint32_t word = 0;
  std::memcpy(&word, device().mapped(large).data() + kLarge - 4, sizeof word);
  EXPECT_EQ(word, 0xabcdu);
  device().destroy(large);
  EXPECT_EQ(bytes_of("test"), 0u);
}

TEST_F(Memory, buffers_that_come_and_go_never_share_bytes) {
  std::mt19937 random(3);
  std::vector<std::pair<BufferHandle, std::uint8_t>> live;
  for (int step = 0; step < 300; ++step) {
    if (live.size() > 40 || (!live.empty() && random() % 3 == 0)) {
      const std::size_t victim = random() % live.size();
      device().destroy(live[victim].first);
      live.erase(live.begin() + static_cast<std::ptrdiff_t>(victim));
      continue;
    }
    const auto mark = static_cast<std::uint8_t>(random());
    const BufferHandle buffer = make("test", 1 + random() % 5000, MemoryKind::upload);
    const auto bytes = device().mapped(buffer);
    std::memset(bytes.data(), mark, bytes.size());
    live.emplace_back(buffer, mark);
  }
  for (const auto& [buffer, mark] : live) {
    for (const std::byte b : device().mapped(buffer)) ASSERT_EQ(static_cast<std::uint8_t>(b), mark);
  }
}

TEST_F(Memory, images_and_buffers_of_a_block_share_its_bytes_one_after_another) {
  using enum ImageUsage;
  const ImageDesc image_desc = {.name = "image",
                                .module = "test",
                                .format = Format::r32_uint,
                                .width = 32,
                                .height = 32,
                                .usage = transfer_source | transfer_target};
  const BufferDesc buffer_desc = {.name = "buffer",
                                  .module = "test",
                                  .size = 4096,
                                  .usage = BufferUsage::transfer_source | BufferUsage::transfer_target};
  const auto image_needs = test::value_of(device().memory_needs(image_desc));
  const auto buffer_needs = test::value_of(device().memory_needs(buffer_desc));
  ASSERT_GE(image_needs.size, 4096u);
  const std::uint64_t size = std::max(image_needs.size, buffer_needs.size);
  const auto block = test::value_of(device().create_memory(
      {.name = "block", .module = "block", .size = size, .types = image_needs.types & buffer_needs.types}));
  EXPECT_EQ(bytes_of("block"), size);
  const auto image = test::value_of(device().create_image(image_desc, {block, 0}));
  const auto buffer = test::value_of(device().create_buffer(buffer_desc, {block, 0}));
  EXPECT_EQ(bytes_of("test"), 0u);
  device().account(block, std::array{ModuleMemory{"test", 1000}});
  EXPECT_EQ(bytes_of("test"), 1000u);
  EXPECT_EQ(bytes_of("block"), size - 1000);
  BufferHandle read_image;
  const BufferHandle read_buffer = test::make_readback(device(), 4096);
  device().destroy(block);  // the objects keep the memory
  test::run_frame(device(), [&](CommandList& commands) {
    to(commands, image, Access::none, Access::transfer_write);
    commands.clear_color_image(image, {7u, 0u, 0u, 0u});
    read_image = read_layer(commands, image, Access::transfer_write);
    const BufferBarrier takes_over{
        .buffer = buffer, .after = Access::transfer_write, .also_before = mask_of(Access::transfer_read)};
    commands.barrier({&takes_over, 1}, {});
    commands.fill_buffer(buffer, 0, 4096, 9);
    to(commands, buffer, Access::transfer_write, Access::transfer_read);
    commands.copy_buffer(buffer, 0, read_buffer, 0, 4096);
    to(commands, read_buffer, Access::transfer_write, Access::host_read);
  });
  for (const std::uint32_t word : test::items_of<std::uint32_t>(device(), read_image)) ASSERT_EQ(word, 7u);
  for (const std::uint32_t word : test::items_of<std::uint32_t>(device(), read_buffer)) ASSERT_EQ(word, 9u);
  device().destroy(image);
  EXPECT_GT(bytes_of("block"), 0u);
  device().destroy(buffer);
  EXPECT_EQ(bytes_of("block"), 0u);
}

TEST_F(Memory, misplaced_objects_assert) {
  const BufferDesc desc = {.name = "buffer", .module = "test", .size = 4096, .usage = BufferUsage::storage};
  const auto needs = test::value_of(device().memory_needs(desc));
  const auto block = test::value_of(
      device().create_memory({.name = "block", .module = "test", .size = needs.size, .types = needs.types}));
  EXPECT_ASSERT((void)device().create_buffer(desc, {block, 4096}), "\"buffer\" lies inside its memory block");
  EXPECT_ASSERT(device().account(block, std::array{ModuleMemory{"a", needs.size + 1}}), "no more bytes are accounted");
  device().destroy(block);
}

TEST_F(Memory, running_out_is_an_error_that_names_object_module_and_bytes) {
  std::vector<BufferHandle> buffers;
  for (int i = 0; i < 4096; ++i) {
    auto made =
        device().create_buffer({.name = "hog", .module = "greedy", .size = 1ull << 40, .usage = BufferUsage::storage});
    if (made) {
      buffers.push_back(*made);
      continue;
    }
    EXPECT_EQ(made.error().kind, ErrorKind::failed);
    EXPECT_NE(made.error().message.find("\"hog\" of module \"greedy\""), std::string::npos) << made.error().message;
    return;
  }
  FAIL() << "the device gave out " << buffers.size() << " TiB";
}

}  // namespace
}  // namespace gloam::gpu
