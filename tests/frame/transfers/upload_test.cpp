// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/transfers/upload.h"

#include <algorithm>

#include "tests/frame/graph_fixture.h"
#include "tests/support/expect_assert.h"

namespace gloam::test {
namespace {

using UploadTest = GraphFixture;

std::vector<std::byte> counting_bytes(std::size_t count) {
  std::vector<std::byte> bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>(i * 7 + 1);
  return bytes;
}

TEST_F(UploadTest, ring_slices_are_aligned_disjoint_and_hold_what_was_written) {
  ASSERT_TRUE(device->begin_frame().ok());
  UploadRing ring(*device, "test", gpu::BufferUsage::uniform, 1024);
  ring.begin_frame();
  const auto first = ring.write(counting_bytes(10)).value();
  const auto second = ring.write_value(std::uint32_t{42}).value();
  EXPECT_EQ(first.buffer, second.buffer);
  EXPECT_EQ(first.offset, 0u);
  EXPECT_EQ(first.size, 10u);
  EXPECT_EQ(second.offset, 256u);
  EXPECT_EQ(device->mapped(second.buffer)[256], std::byte{42});
  EXPECT_ASSERT((void)ring.allocate(0), "at least one byte");
  ASSERT_TRUE(device->submit_frame().ok());
}

TEST_F(UploadTest, a_ring_grows_within_a_frame_and_merges_its_blocks_in_the_slots_next_one) {
  UploadRing ring(*device, "test", gpu::BufferUsage::storage, 256);
  const auto frame = [&](int slices) {
    ASSERT_TRUE(device->begin_frame().ok());
    ring.begin_frame();
    for (int i = 0; i < slices; ++i) ASSERT_TRUE(ring.allocate(256).ok());
    ASSERT_TRUE(device->submit_frame().ok());
  };
  frame(3);  // blocks of 256 and 512
  frame(1);  // the other slot
  EXPECT_EQ(bytes_of_module("test"), 256u + 512 + 256);
  frame(3);
  EXPECT_EQ(bytes_of_module("test"), 768u + 256);
}

TEST_F(UploadTest, a_slice_larger_than_all_blocks_gets_its_own) {
  ASSERT_TRUE(device->begin_frame().ok());
  UploadRing ring(*device, "test", gpu::BufferUsage::storage, 256);
  ring.begin_frame();
  const auto slice = ring.allocate(100000);
  ASSERT_TRUE(slice.ok());
  EXPECT_EQ(slice->bytes.size(), 100000u);
  ASSERT_TRUE(device->submit_frame().ok());
}

TEST_F(UploadTest, slots_of_frames_in_flight_do_not_share_memory) {
  UploadRing ring(*device, "test", gpu::BufferUsage::storage);
  std::vector<gpu::BufferHandle> buffers;
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(device->begin_frame().ok());
    ring.begin_frame();
    buffers.push_back(ring.allocate(16)->buffer);
    ASSERT_TRUE(device->submit_frame().ok());
  }
  EXPECT_NE(buffers[0], buffers[1]);
}

TEST_F(UploadTest, the_uploader_fills_buffers) {
  const auto bytes = counting_bytes(100);
  const gpu::BufferHandle target =
      make_buffer({.name = "target", .module = "test", .size = 100, .memory = gpu::MemoryKind::readback},
                  gpu::BufferUsage::transfer_target);
  Uploader uploader(*device);
  uploader.buffer(target, bytes, Access::host_read);
  EXPECT_TRUE(texts("copy_buffer").empty());
  ASSERT_TRUE(uploader.flush().ok());
  EXPECT_TRUE(std::ranges::equal(device->mapped(target), bytes));
  EXPECT_EQ(bytes_of_module("engine"), 0u);  // the staging buffer is freed
  EXPECT_EQ(device->frame_number(), 1u);
  ASSERT_TRUE(uploader.flush().ok());
  EXPECT_EQ(device->frame_number(), 1u);  // nothing left to do
}

TEST_F(UploadTest, the_uploader_fills_every_mip_of_every_layer) {
  gpu::ImageDesc desc = image_desc("target", 4);
  desc.mips = 3;
  desc.layers = 2;
  const gpu::ImageHandle target = make_image(desc, gpu::ImageUsage::transfer_target | gpu::ImageUsage::sampled);
  Uploader uploader(*device);
  uploader.image(target, counting_bytes(2 * (64 + 16 + 4)), Access::fragment_read);
  ASSERT_TRUE(uploader.flush().ok());
  EXPECT_THAT(texts("copy_buffer_to_image"),
              testing::ElementsAre("copy_buffer_to_image 'upload staging'+0 > 'target' mip 0 layers 0+1",
                                   "copy_buffer_to_image 'upload staging'+64 > 'target' mip 1 layers 0+1",
                                   "copy_buffer_to_image 'upload staging'+80 > 'target' mip 2 layers 0+1",
                                   "copy_buffer_to_image 'upload staging'+84 > 'target' mip 0 layers 1+1",
                                   "copy_buffer_to_image 'upload staging'+148 > 'target' mip 1 layers 1+1",
                                   "copy_buffer_to_image 'upload staging'+164 > 'target' mip 2 layers 1+1"));
  EXPECT_ASSERT(uploader.image(target, counting_bytes(3), Access::fragment_read), "all mips of all layers");
}

TEST_F(UploadTest, uploads_that_do_not_fit_one_submission_take_turns_in_two_staging_buffers) {
  constexpr std::uint64_t kBytes = 8u << 20;  // two do not fit one submission
  std::vector<gpu::BufferHandle> targets;
  Uploader uploader(*device);
  for (int i = 0; i < 5; ++i) {
    targets.push_back(
        make_buffer({.name = "target", .module = "test", .size = kBytes, .memory = gpu::MemoryKind::readback},
                    gpu::BufferUsage::transfer_target));
    uploader.buffer(targets.back(), std::vector<std::byte>(kBytes, static_cast<std::byte>(i + 1)), Access::host_read);
  }
  const auto executor = make_shuffled_executor(3);
  ASSERT_TRUE(uploader.flush(*executor).ok());
  EXPECT_EQ(device->frame_number(), 5u);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(device->mapped(targets[static_cast<std::size_t>(i)]).front(), static_cast<std::byte>(i + 1));
    EXPECT_EQ(device->mapped(targets[static_cast<std::size_t>(i)]).back(), static_cast<std::byte>(i + 1));
  }
}

TEST_F(UploadTest, texels_may_be_made_in_staging_memory) {
  const gpu::ImageHandle target =
      make_image(image_desc("target", 4), gpu::ImageUsage::transfer_target | gpu::ImageUsage::sampled);
  std::size_t given = 0;
  Uploader uploader(*device);
  uploader.image(
      target, [&](std::span<std::byte> texels) { given = texels.size(); }, Access::fragment_read);
  EXPECT_EQ(given, 0u) << "not before its turn";
  ASSERT_TRUE(uploader.flush().ok());
  EXPECT_EQ(given, 64u);
}

TEST_F(UploadTest, an_upload_that_finds_no_memory_says_so) {
  const gpu::BufferHandle target = make_buffer(buffer_desc("target"), gpu::BufferUsage::transfer_target);
  Uploader uploader(*device);
  uploader.buffer(target, counting_bytes(10), Access::compute_read);
  device->fail_next_creation({.message = "no memory"});
  const Status status = uploader.flush();
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().message, "no memory");
}

TEST_F(UploadTest, an_exception_of_a_fill_leaves_no_frame_begun_and_no_memory) {
  const gpu::ImageHandle image = make_image(image_desc("image", 4), gpu::ImageUsage::transfer_target);
  const std::uint64_t bytes = bytes_of_module("engine");
  for (const auto& executor : {make_serial_executor(), make_shuffled_executor(2), make_pool_executor(3)}) {
    Uploader uploader(*device);
    uploader.image(
        image, [](std::span<std::byte>) { throw std::runtime_error("the file is gone"); }, Access::fragment_read);
    EXPECT_THROW((void)uploader.flush(*executor), std::runtime_error);
    EXPECT_EQ(bytes_of_module("engine"), bytes);
    uploader.image(image, std::vector<std::byte>(4 * 4 * 4, std::byte{7}), Access::fragment_read);
    const Status flushed = uploader.flush(*executor);
    EXPECT_TRUE(flushed.ok());
  }
}

}  // namespace
}  // namespace gloam::test
