// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <bit>
#include <random>

#include "engine/frame/frame_graph.h"
#include "engine/frame/history.h"
#include "engine/frame/transfers/readback.h"
#include "engine/frame/transfers/upload.h"
#include "shaders/gpu_test/shaders.h"
#include "tests/frame/random_frames.h"
#include "tests/support/gpu_device.h"

namespace gloam::test {
namespace {

using gpu::Access;

constexpr std::uint32_t kCount = 256;  ///< numbers per buffer

/// A real device; any validation message fails the test.
class FrameGraphGpuTest : public testing::Test {
 public:
  void SetUp() override { GLOAM_REQUIRE_GPU(device); }
  void TearDown() override {
    if (device != nullptr) {
      EXPECT_EQ(device->validation_messages(), 0u);
    }
  }
  void run_frame(FrameGraph& graph, const std::function<void()>& declare) {
    auto commands = device->begin_frame();
    ASSERT_TRUE(commands.ok()) << commands.error().message;
    graph.begin();
    declare();
    const Status compiled = graph.compile();
    ASSERT_TRUE(compiled.ok()) << compiled.error().message;
    graph.execute(**commands);
    const Status submitted = device->submit_frame();
    ASSERT_TRUE(submitted.ok()) << submitted.error().message;
  }

  std::unique_ptr<gpu::Device> device = make_test_device();
};

std::vector<std::uint32_t> words_of(const std::vector<std::byte>& bytes) {
  std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
  std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
  return words;
}

TEST_F(FrameGraphGpuTest, random_frames_copy_what_was_written_and_validate) {
  std::mt19937 random(7);
  for (int i = 0; i < 40; ++i) {
    std::vector<std::uint32_t> numbers(random() % 60);
    for (std::uint32_t& n : numbers) n = static_cast<std::uint32_t>(random());
    const RandomFrame frame = RandomFrame::from(numbers);
    RandomFrameRunner runner(frame, *device, false);
    const auto all = static_cast<std::uint32_t>(frame.passes.size());
    for (const std::uint32_t passes : {all, all, all / 2, all}) {
      (void)runner.run(passes);
      // Some frames overlap with the previous frame, some do not.
      if (random() % 2 == 0) continue;
      ASSERT_TRUE(device->wait_idle().ok());
      EXPECT_EQ(runner.wrong_contents(), "") << "random frame " << i;
    }
    ASSERT_TRUE(device->wait_idle().ok());
    ASSERT_EQ(device->validation_messages(), 0u) << "random frame " << i;
  }
}

TEST_F(FrameGraphGpuTest, kernels_compute_through_transient_buffers_that_share_memory) {
  const auto kernel = value_of(device->create_pipeline(
      gpu::ComputePipelineDesc{.name = "double", .module = "test", .shader = shaders::gpu_test::double_numbers_comp}));
  FrameGraph graph(*device);
  Readback readback(*device);
  UploadRing ring(*device, "test", gpu::BufferUsage::uniform | gpu::BufferUsage::storage);
  std::vector<ReadbackTicket> tickets;
  for (std::uint32_t frame = 0; frame < 4; ++frame) {
    run_frame(graph, [&] {
      ring.begin_frame();
      const auto offset = value_of(ring.write_value(frame));
      PassBuilder fill = graph.add_pass("fill", "test");
      BufferRef numbers = fill.write(graph.create_buffer({.name = "numbers", .module = "test", .size = kCount * 4}),
                                     Access::transfer_write);
      fill.execute([numbers](PassContext& context) {
        context.commands().fill_buffer(context.buffer(numbers), 0, kCount * 4, 1);
      });
      // Six doublings through transient buffers; at most two of them are live at once.
      for (int step = 0; step < 6; ++step) {
        PassBuilder pass = graph.add_pass("double", "test");
        pass.read(numbers, Access::compute_read);
        const BufferRef doubled = pass.write(
            graph.create_buffer({.name = "doubled", .module = "test", .size = kCount * 4}), Access::compute_write);
        pass.execute([=](PassContext& context) {
          context.commands().bind_pipeline(kernel);
          const std::array<gpu::Binding, 3> bindings = {{
              {0, gpu::Binding::BufferRange{.buffer = context.buffer(numbers)}},
              {1, gpu::Binding::BufferRange{.buffer = context.buffer(doubled)}},
              {2, offset},
          }};
          context.commands().bind(bindings);
          context.commands().push(kCount);
          context.commands().dispatch(kCount / 64, 1, 1);
        });
        numbers = doubled;
      }
      tickets.push_back(value_of(readback.read_buffer(graph, numbers)));
    });
    EXPECT_EQ(graph.transient_bytes(), 2 * kCount * 4);
  }
  ASSERT_TRUE(device->wait_idle().ok());
  for (std::uint32_t frame = 0; frame < 4; ++frame) {
    const auto bytes = readback.take(tickets[frame]);
    ASSERT_TRUE(bytes.has_value());
    EXPECT_THAT(words_of(*bytes), testing::Each(64 + 63 * frame));
  }
  device->destroy(kernel);
  EXPECT_EQ(graph.plans_compiled(), 1u);
  const std::vector<PassTime> times = graph.pass_times();
  ASSERT_EQ(times.size(), 8u);
  EXPECT_EQ(times[1].dispatches, 1u);
  EXPECT_GT(graph.gpu_ms(), 0.0);
}

TEST_F(FrameGraphGpuTest, plans_of_growing_and_shrinking_sizes_share_memory_without_hazards) {
  FrameGraph graph(*device);
  Readback readback(*device);
  std::mt19937 random(3);
  std::vector<std::pair<ReadbackTicket, std::uint32_t>> tickets;
  for (std::uint32_t frame = 0; frame < 60; ++frame) {
    const std::uint32_t side = 4u << (random() % 6);
    const std::uint32_t words = 64u << (random() % 5);
    run_frame(graph, [&] {
      // Two images and a buffer that live at different times, so that each plan places them in other bytes.
      PassBuilder clear = graph.add_pass("clear", "test");
      gpu::ImageDesc desc = {.name = "image", .module = "test", .format = gpu::Format::r32_uint};
      desc.width = desc.height = side;
      const ImageRef image = clear.write(graph.create_image(desc), Access::transfer_write);
      clear.execute([=](PassContext& context) {
        context.commands().clear_color_image(context.image(image), {frame + 1, 0, 0, 0});
      });
      tickets.emplace_back(value_of(readback.read_image(graph, image)), frame + 1);
      PassBuilder fill = graph.add_pass("fill", "test");
      const BufferRef buffer = fill.write(graph.create_buffer({.name = "words", .module = "test", .size = words * 4}),
                                          Access::transfer_write);
      fill.execute([=](PassContext& context) {
        context.commands().fill_buffer(context.buffer(buffer), 0, words * 4, frame + 1001);
      });
      desc.width = side / 2;
      PassBuilder paint = graph.add_pass("paint", "test");
      const ImageRef other = paint.write(graph.create_image(desc), Access::color_target);
      paint.execute([=](PassContext& context) {
        const float bits = std::bit_cast<float>(frame + 2001);
        context.commands().begin_rendering({.colors = {{.view = {context.image(other)}, .clear = {bits, 0, 0, 0}}},
                                            .width = side / 2,
                                            .height = side});
        context.commands().end_rendering();
      });
      tickets.emplace_back(value_of(readback.read_buffer(graph, buffer)), frame + 1001);
      tickets.emplace_back(value_of(readback.read_image(graph, other)), frame + 2001);
    });
    if (random() % 8 == 0) graph.free_idle_memory();
  }
  ASSERT_TRUE(device->wait_idle().ok());
  for (const auto& [ticket, value] : tickets) {
    const auto bytes = readback.take(ticket);
    ASSERT_TRUE(bytes.has_value());
    ASSERT_THAT(words_of(*bytes), testing::Each(value));
  }
}

TEST_F(FrameGraphGpuTest, histories_and_uploads_hold_their_contents) {
  FrameGraph graph(*device);
  History history(*device);
  Readback readback(*device);
  Uploader uploader(*device);
  gpu::ImageDesc desc = {.name = "picture",
                         .module = "test",
                         .format = gpu::Format::r32_uint,
                         .width = 2,
                         .height = 2,
                         .usage = gpu::ImageUsage::transfer_source | gpu::ImageUsage::transfer_target};
  const auto picture = value_of(device->create_image(desc));
  std::vector<std::byte> texels(16);
  for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<std::byte>(i);
  uploader.image(picture, texels, Access::transfer_read);
  ASSERT_TRUE(uploader.flush().ok());
  ReadbackTicket from_upload;
  ReadbackTicket from_history;
  desc.name = "kept";
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    run_frame(graph, [&] {
      history.begin_frame();
      const auto pair = value_of(
          history.image_pair(graph, {.world = 1, .frame = frame}, desc, {.final_access = Access::transfer_read}));
      PassBuilder pass = graph.add_pass("write", "test");
      const ImageRef current = pass.write(pair.current, Access::transfer_write);
      pass.execute([=](PassContext& context) {
        context.commands().clear_color_image(context.image(current), {frame + 10, 0, 0, 0});
      });
      if (frame < 2) return;
      from_history = value_of(readback.read_image(graph, pair.previous));
      const ImageRef imported = graph.import_image("picture", picture, Access::transfer_read, Access::transfer_read);
      from_upload = value_of(readback.read_image(graph, imported));
    });
    history.commit(graph);
  }
  ASSERT_TRUE(device->wait_idle().ok());
  EXPECT_EQ(readback.take(from_upload), texels);
  const auto kept = readback.take(from_history);
  ASSERT_TRUE(kept.has_value());
  EXPECT_THAT(words_of(*kept), testing::Each(11u));
  device->destroy(picture);
}

}  // namespace
}  // namespace gloam::test
