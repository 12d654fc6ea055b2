// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/transfers/results.h"

#include "tests/frame/graph_fixture.h"
#include "tests/support/expect_assert.h"

namespace gloam::test {
namespace {

struct FrameResultsTest : GraphFixture {
  FrameResults results{*device};

  static ResultKey key(std::string name = "number", std::uint64_t world = 1, std::uint32_t view = 0) {
    return {"test", std::move(name), world, view};
  }

  /// Runs one frame that keeps `word` under each key.
  void frame(std::uint32_t word, const std::vector<ResultKey>& keys) {
    run_frame([&](FrameGraph& g) {
      results.begin_frame();
      for (const ResultKey& k : keys) {
        PassBuilder fill = g.add_pass("fill", "test");
        const BufferRef filled = fill.write(g.create_buffer(buffer_desc("words", 16)), Access::transfer_write);
        fill.execute([filled, word](PassContext& context) {
          context.commands().fill_buffer(context.buffer(filled), 0, 16, word);
        });
        results.keep(k, filled, 4, 4, word + 1000);
      }
      ASSERT_TRUE(results.add_pass(g).ok());
    });
  }
  /// A buffer of four words that a pass of the graph writes.
  [[nodiscard]] BufferRef add_words() {
    return graph.add_pass("fill", "test").write(graph.create_buffer(buffer_desc("words", 16)), Access::transfer_write);
  }
  [[nodiscard]] std::uint32_t settled_word(const ResultKey& k) const {
    const FrameResult* result = results.settled(k);
    return result == nullptr ? 0 : result->value<std::uint32_t>();
  }
  [[nodiscard]] std::uint32_t newest_word(const ResultKey& k) const {
    const auto result = results.newest(k);
    return result ? result->value<std::uint32_t>() : 0;
  }
};

TEST_F(FrameResultsTest, settle_two_frames_later_however_fast_the_device_is) {
  for (std::uint32_t i = 1; i <= 5; ++i) {
    frame(i, {key()});
    EXPECT_EQ(settled_word(key()), i < 3 ? 0 : i - 2);
    EXPECT_EQ(newest_word(key()), i) << "the recording device is done at once";
  }
}

TEST_F(FrameResultsTest, carry_the_note_of_their_frame) {
  for (std::uint32_t i = 1; i <= 3; ++i) frame(i, {key()});
  ASSERT_NE(results.settled(key()), nullptr);
  EXPECT_EQ(std::any_cast<std::uint32_t>(results.settled(key())->note), 1001u);
  EXPECT_ASSERT((void)results.settled(key())->value<std::uint64_t>(), "read as what was kept");
}

TEST_F(FrameResultsTest, belong_to_one_name_world_and_view) {
  const std::vector<ResultKey> keys = {key("a"), key("b"), key("a", 2), key("a", 1, 7)};
  frame(1, {keys[0]});
  frame(2, {keys[1], keys[2]});
  frame(3, {keys[3]});
  EXPECT_EQ(results.kept_keys(), std::vector<ResultKey>{keys[3]});
  frame(4, {});
  frame(5, {});
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(settled_word(keys[i]), i == 0 ? 1u : i < 3 ? 2u : 3u);
  std::vector<std::string> seen;
  results.for_each_settled(1, 0, [&](const ResultKey& k, const FrameResult&) { seen.push_back(k.name); });
  EXPECT_THAT(seen, testing::ElementsAre("a", "b"));
  results.forget_world(2);
  EXPECT_EQ(results.settled(keys[2]), nullptr);
  EXPECT_NE(results.settled(keys[0]), nullptr);
  results.forget_module("test");
  for (const ResultKey& k : keys) EXPECT_FALSE(results.newest(k).has_value());
}

TEST_F(FrameResultsTest, cost_one_pass_and_no_memory_without_requests) {
  frame(1, {});
  EXPECT_TRUE(texts("copy_buffer").empty());
  EXPECT_EQ(bytes_of_module("engine"), 0u);
  for (std::uint32_t i = 0; i < 6; ++i) frame(i, {key("a"), key("b")});
  EXPECT_EQ(bytes_of_module("engine"), 2u * 4096u) << "a piece a frame in flight";
  EXPECT_EQ(graph.plans_compiled(), 2u) << "one without and one with results";
}

TEST_F(FrameResultsTest, grow_with_what_is_kept) {
  std::vector<ResultKey> many;
  for (std::uint32_t i = 0; i < 600; ++i) many.push_back(key("k", 1, i));
  frame(7, {key("k", 1, 599)});
  frame(8, many);
  frame(9, {key()});
  frame(10, {key()});
  for (const ResultKey& k : many) ASSERT_EQ(settled_word(k), 8u);
}

TEST_F(FrameResultsTest, and_their_memory_go_when_nobody_renews_them) {
  frame(1, {key()});
  frame(2, {key()});
  for (std::uint64_t i = 0; i < FrameResults::kFramesKept; ++i) frame(0, {});
  EXPECT_NE(results.settled(key()), nullptr);
  for (int i = 0; i < 3; ++i) frame(0, {});
  EXPECT_EQ(results.settled(key()), nullptr);
  EXPECT_EQ(bytes_of_module("engine"), 0u);
}

TEST_F(FrameResultsTest, of_a_frame_that_was_given_up_are_none) {
  auto commands = device->begin_frame();
  ASSERT_TRUE(commands.ok());
  results.begin_frame();
  graph.begin();
  results.keep(key(), add_words(), 0, 4);
  ASSERT_TRUE(device->submit_frame().ok());
  EXPECT_FALSE(results.newest(key()).has_value());
  for (std::uint32_t i = 0; i < 3; ++i) frame(i, {});
  EXPECT_EQ(results.settled(key()), nullptr);
}

TEST_F(FrameResultsTest, of_a_frame_that_was_given_up_after_its_copies_were_recorded_are_none) {
  frame(1, {key()});
  auto commands = device->begin_frame();
  ASSERT_TRUE(commands.ok());
  results.begin_frame();
  graph.begin();
  results.keep(key(), add_words(), 0, 4);
  ASSERT_TRUE(results.add_pass(graph).ok());
  ASSERT_TRUE(graph.compile().ok());
  graph.execute(**commands);
  results.give_up_frame();
  ASSERT_TRUE(device->abandon_frame().ok());
  ASSERT_TRUE(results.newest(key()).has_value());
  EXPECT_EQ(results.newest(key())->frame, 0u);
  for (std::uint32_t i = 0; i < 3; ++i) frame(i, {});
  ASSERT_NE(results.settled(key()), nullptr);
  EXPECT_EQ(results.settled(key())->frame, 0u);
}

TEST_F(FrameResultsTest, are_asked_for_once_a_key_and_in_words) {
  run_frame([&](FrameGraph&) {
    results.begin_frame();
    const BufferRef words = add_words();
    results.keep(key(), words, 0, 4);
    EXPECT_ASSERT(results.keep(key(), words, 0, 4), "one result a key");
    EXPECT_ASSERT(results.keep(key("other"), words, 0, 3), "some words of a buffer");
  });
}

}  // namespace
}  // namespace gloam::test
