// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/history.h"

#include "tests/frame/graph_fixture.h"
#include "tests/support/expect_assert.h"

namespace gloam::test {
namespace {

class HistoryTest : public GraphFixture {
 public:
  struct Seen {
    gpu::ImageHandle previous;
    gpu::ImageHandle current;
    bool valid = false;
    std::uint64_t age = 0;
  };
  /// Runs one frame that reads the previous image and writes the current one.
  Seen run_history_frame(std::uint32_t side = 8) {
    Seen seen;
    run_frame([&](FrameGraph& g) {
      history.begin_frame();
      gpu::ImageDesc desc = image_desc("temporal", side);
      desc.usage = gpu::ImageUsage::transfer_source | gpu::ImageUsage::transfer_target;
      const HistoryImage pair = history.image(g, desc, Access::transfer_read).value();
      seen.valid = pair.valid;
      seen.age = pair.age;
      PassBuilder pass = g.add_pass("blend", "test");
      pass.read(pair.previous, Access::transfer_read);
      const ImageRef current = pass.write(pair.current, Access::transfer_write);
      pass.execute([&seen, pair, current](PassContext& context) {
        seen.previous = context.image(pair.previous);
        seen.current = context.image(current);
        context.commands().blit(seen.previous, seen.current);
      });
    });
    return seen;
  }
  void idle_frame() {
    run_frame([&](FrameGraph&) { history.begin_frame(); });
  }

  History history{*device};
};

TEST_F(HistoryTest, what_was_current_is_previous_in_the_next_frame) {
  const Seen first = run_history_frame();
  const Seen second = run_history_frame();
  const Seen third = run_history_frame();
  EXPECT_FALSE(first.valid);
  EXPECT_TRUE(second.valid);
  EXPECT_EQ(second.age, 1u);
  EXPECT_EQ(second.previous, first.current);
  EXPECT_EQ(second.current, first.previous);
  EXPECT_EQ(third.previous, second.current);
}

TEST_F(HistoryTest, another_size_makes_new_images_without_contents) {
  const Seen first = run_history_frame(8);
  const Seen resized = run_history_frame(16);
  EXPECT_FALSE(resized.valid);
  EXPECT_NE(resized.previous, first.current);
  EXPECT_TRUE(run_history_frame(16).valid);
  EXPECT_EQ(bytes_of_module("test"), 2u * 16 * 16 * 4);
}

TEST_F(HistoryTest, a_reset_invalidates_the_next_use_only) {
  (void)run_history_frame();
  history.reset("test", "temporal");
  EXPECT_FALSE(run_history_frame().valid);
  EXPECT_TRUE(run_history_frame().valid);
  history.reset_all();
  EXPECT_FALSE(run_history_frame().valid);
}

TEST_F(HistoryTest, a_pause_shows_as_age) {
  (void)run_history_frame();
  idle_frame();
  idle_frame();
  const Seen seen = run_history_frame();
  EXPECT_TRUE(seen.valid);
  EXPECT_EQ(seen.age, 3u);
}

TEST_F(HistoryTest, pairs_that_nobody_uses_are_released) {
  (void)run_history_frame();
  for (std::uint64_t i = 0; i < History::kFramesKept; ++i) idle_frame();
  EXPECT_EQ(history.size(), 1u);
  idle_frame();
  EXPECT_EQ(history.size(), 0u);
  EXPECT_EQ(bytes_of_module("test"), 0u);
  EXPECT_FALSE(run_history_frame().valid);
}

TEST_F(HistoryTest, buffers_pass_from_frame_to_frame_too) {
  for (int frame = 0; frame < 3; ++frame) {
    run_frame([&](FrameGraph& g) {
      history.begin_frame();
      gpu::BufferDesc desc = buffer_desc("blades", 64);
      desc.usage = gpu::BufferUsage::transfer_source | gpu::BufferUsage::transfer_target;
      const HistoryBuffer pair = history.buffer(g, desc, Access::transfer_read).value();
      EXPECT_EQ(pair.valid, frame > 0);
      PassBuilder pass = g.add_pass("simulate", "test");
      pass.read(pair.previous, Access::transfer_read);
      const BufferRef current = pass.write(pair.current, Access::transfer_write);
      pass.execute([pair, current](PassContext& context) {
        context.commands().copy_buffer(context.buffer(pair.previous), 0, context.buffer(current), 0, 64);
      });
    });
  }
  EXPECT_EQ(history.size(), 1u);
}

TEST_F(HistoryTest, a_pair_is_asked_for_once_a_frame) {
  graph.begin();
  history.begin_frame();
  gpu::ImageDesc desc = image_desc("temporal");
  desc.usage = gpu::ImageUsage::sampled;
  ASSERT_TRUE(history.image(graph, desc, Access::fragment_read).ok());
  EXPECT_ASSERT((void)history.image(graph, desc, Access::fragment_read), "once a frame");
}

}  // namespace
}  // namespace gloam::test
