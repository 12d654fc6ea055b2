// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/transfers/readback.h"

#include "engine/frame/transfers/upload.h"
#include "tests/frame/graph_fixture.h"
#include "tests/support/expect_assert.h"

namespace gloam::test {
namespace {

using ReadbackTest = GraphFixture;

TEST_F(ReadbackTest, bytes_of_a_buffer_come_back_once_after_its_frame) {
  Readback readback(*device);
  ReadbackTicket ticket;
  run_frame([&](FrameGraph& g) {
    PassBuilder fill = g.add_pass("fill", "test");
    const BufferRef filled = fill.write(g.create_buffer(buffer_desc("numbers", 16)), Access::transfer_write);
    fill.execute(
        [filled](PassContext& context) { context.commands().fill_buffer(context.buffer(filled), 0, 16, 0x01020304); });
    ticket = readback.read_buffer(g, filled, 4, 8).value();
    EXPECT_FALSE(readback.take(ticket).has_value());
  });
  const auto bytes = readback.take(ticket);
  ASSERT_TRUE(bytes.has_value());
  ASSERT_EQ(bytes->size(), 8u);
  EXPECT_EQ((*bytes)[0], std::byte{4});
  EXPECT_EQ((*bytes)[3], std::byte{1});
  EXPECT_FALSE(readback.take(ticket).has_value());
}

TEST_F(ReadbackTest, texels_of_one_mip_and_layer_come_back) {
  gpu::ImageDesc desc = image_desc("picture", 2);
  desc.mips = 2;
  desc.layers = 2;
  const gpu::ImageHandle image =
      make_image(desc, gpu::ImageUsage::transfer_target | gpu::ImageUsage::transfer_source | gpu::ImageUsage::sampled);
  std::vector<std::byte> texels(2 * (16 + 4));
  for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<std::byte>(i);
  Uploader uploader(*device);
  uploader.image(image, texels, Access::fragment_read);
  ASSERT_TRUE(uploader.flush().ok());
  Readback readback(*device);
  ReadbackTicket ticket;
  run_frame([&](FrameGraph& g) {
    const ImageRef ref = g.import_image("picture", image, Access::fragment_read, Access::fragment_read);
    EXPECT_ASSERT((void)readback.read_image(g, ref, 2, 0), "no such mip or layer");
    ticket = readback.read_image(g, ref, 1, 1).value();
  });
  const auto bytes = readback.take(ticket);
  ASSERT_TRUE(bytes.has_value());
  EXPECT_THAT(*bytes, testing::ElementsAre(std::byte{36}, std::byte{37}, std::byte{38}, std::byte{39}));
}

TEST_F(ReadbackTest, memory_is_used_again_and_a_steady_frame_compiles_once) {
  Readback readback(*device);
  for (int frame = 0; frame < 10; ++frame) {
    ReadbackTicket ticket;
    run_frame([&](FrameGraph& g) {
      const BufferRef written =
          g.add_pass("fill", "test").write(g.create_buffer(buffer_desc("numbers", 16)), Access::transfer_write);
      ticket = readback.read_buffer(g, written).value();
    });
    EXPECT_TRUE(readback.take(ticket).has_value());
  }
  EXPECT_EQ(graph.plans_compiled(), 1u);
  EXPECT_EQ(bytes_of_module("engine"), 256u);
}

TEST_F(ReadbackTest, dropped_requests_hand_nothing_out_and_give_their_memory_back) {
  Readback readback(*device);
  for (int frame = 0; frame < 4; ++frame) {
    ReadbackTicket ticket;
    run_frame([&](FrameGraph& g) {
      const BufferRef written =
          g.add_pass("fill", "test").write(g.create_buffer(buffer_desc("numbers", 16)), Access::transfer_write);
      ticket = readback.read_buffer(g, written).value();
      readback.drop(ticket);
    });
    EXPECT_FALSE(readback.take(ticket).has_value());
    EXPECT_EQ(readback.open_requests(), 0u);
  }
  EXPECT_EQ(bytes_of_module("engine"), 256u);
}

}  // namespace
}  // namespace gloam::test
