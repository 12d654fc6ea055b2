// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/history.h"

#include <optional>
#include <stdexcept>
#include <utility>

#include "tests/frame/graph_fixture.h"
#include "tests/support/expect_assert.h"

namespace gloam::test {
namespace {

/// The point of a frame at which it is given up.
enum class Lost { no, declaring, compiling, recording, submitting };

class HistoryTest : public GraphFixture {
 public:
  struct Seen {
    HistoryState state;
    gpu::ImageHandle previous;
    gpu::ImageHandle current;
  };

  [[nodiscard]] static gpu::ImageDesc temporal_desc(std::uint32_t side = 8) {
    gpu::ImageDesc desc = image_desc("temporal", side);
    desc.usage = gpu::ImageUsage::transfer_source | gpu::ImageUsage::transfer_target;
    return desc;
  }
  [[nodiscard]] static gpu::BufferDesc knots_desc() {
    gpu::BufferDesc desc = buffer_desc("knots", 64);
    desc.usage = gpu::BufferUsage::transfer_source | gpu::BufferUsage::transfer_target;
    return desc;
  }

  /// Begins a frame with the next number of `world`, calls `declare`, and ends it as `lost` says.
  template <class Declare>
  void frame(Declare&& declare, Lost lost = Lost::no) {
    graph.begin();
    history.begin_frame();
    auto commands = device->begin_frame();
    ASSERT_TRUE(commands.ok());
    const bool throws = lost == Lost::recording;
    // The first pass throws: the device has then recorded no command of the frame.
    PassBuilder first = graph.add_pass("first", "test");
    first.keep();
    first.execute([throws](PassContext&) {
      if (throws) throw std::runtime_error("lost");
    });
    declare();
    if (lost == Lost::compiling) {
      PassBuilder last = graph.add_pass("last", "test");
      static_cast<void>(last.write(graph.create_image(image_desc("transient")), Access::color_target));
      last.keep();
      device->fail_next_creation({ErrorKind::failed, "out of memory"});
    }
    if (lost != Lost::declaring) {
      ASSERT_EQ(graph.compile().ok(), lost != Lost::compiling);
    }
    if (throws) {
      EXPECT_THROW(graph.execute(**commands), std::runtime_error);
      (*commands)->end_label();
    }
    if (lost == Lost::no) graph.execute(**commands);
    ASSERT_TRUE(device->submit_frame().ok());
    if (lost != Lost::no) return;
    history.commit(graph);
    ++view.frame;
  }

  /// Uses the pair in the frame that is being declared; if `writes`, a pass copies previous to current.
  Seen use_pair(std::uint32_t side = 8, bool writes = true) {
    const HistoryImagePair pair = history.image_pair(graph, view, temporal_desc(side), use).value();
    if (writes) {
      PassBuilder pass = graph.add_pass("blend", "test");
      pass.read(pair.previous, Access::transfer_read);
      const ImageRef current = pass.write(pair.current, Access::transfer_write);
      pass.execute([this, pair, current](PassContext& context) {
        blended = {pair, context.image(pair.previous), context.image(current)};
        context.commands().blit(blended.previous, blended.current);
      });
    }
    return {pair, {}, {}};
  }
  Seen pair_frame(std::uint32_t side = 8, Lost lost = Lost::no) {
    blended = {};
    Seen seen;
    frame([&] { seen = use_pair(side); }, lost);
    return lost == Lost::no ? blended : seen;
  }
  /// Uses the buffer in place; if `value` is set, a pass fills it.
  HistoryState use_knots(std::optional<std::uint32_t> value) {
    const HistoryBuffer knots = history.buffer(graph, view, knots_desc(), use).value();
    if (!value) return knots;
    PassBuilder pass = graph.add_pass("simulate", "test");
    const BufferRef written = pass.write(knots.buffer, Access::transfer_write);
    pass.execute([written, value](PassContext& context) {
      context.commands().fill_buffer(context.buffer(written), 0, 64, *value);
    });
    return knots;
  }
  HistoryState knots_frame(std::optional<std::uint32_t> value, Lost lost = Lost::no) {
    HistoryState state;
    frame([&] { state = use_knots(value); }, lost);
    return state;
  }
  void idle_frame() {
    frame([] {});
  }

  History history{*device};
  HistoryView view{.world = 1, .view = 0, .frame = 0, .cut_frame = 0};
  HistoryUse use{.final_access = Access::transfer_read};
  Seen blended;  ///< by the newest frame
};

TEST_F(HistoryTest, what_was_current_is_previous_in_the_next_frame) {
  const Seen first = pair_frame();
  const Seen second = pair_frame();
  const Seen third = pair_frame();
  EXPECT_EQ(first.state.reset, HistoryReset::created);
  EXPECT_EQ(first.state.age, 0u);
  EXPECT_TRUE(second.state.valid());
  EXPECT_EQ(second.state.age, 1u);
  EXPECT_EQ(second.previous, first.current);
  EXPECT_EQ(second.current, first.previous);
  EXPECT_EQ(third.previous, second.current);
  EXPECT_EQ(third.current, second.previous);
}

TEST_F(HistoryTest, a_resource_in_place_is_one_object_that_stays_valid_without_writes) {
  EXPECT_EQ(knots_frame(1).reset, HistoryReset::created);
  for (std::uint64_t age = 1; age < 4; ++age) {
    const HistoryState state = knots_frame(std::nullopt);
    EXPECT_TRUE(state.valid());
    EXPECT_EQ(state.age, age);
  }
  EXPECT_EQ(bytes_of_module("test"), 64u);
}

// Hard case: passes.history_first
TEST_F(HistoryTest, contents_that_no_frame_has_written_stay_undefined) {
  EXPECT_EQ(knots_frame(std::nullopt).reset, HistoryReset::created);
  EXPECT_EQ(knots_frame(std::nullopt).reset, HistoryReset::created);
  EXPECT_EQ(knots_frame(1).reset, HistoryReset::created);
  EXPECT_TRUE(knots_frame(std::nullopt).valid());
}

TEST_F(HistoryTest, a_pair_without_a_write_keeps_its_roles) {
  const Seen first = pair_frame();
  frame([&] { EXPECT_TRUE(use_pair(8, false).state.valid()); });
  const Seen later = pair_frame();
  EXPECT_EQ(later.previous, first.current);
  EXPECT_EQ(later.current, first.previous);
  EXPECT_EQ(later.state.age, 2u);
}

// Hard case: passes.history_resize
TEST_F(HistoryTest, another_size_makes_new_images_without_contents) {
  const Seen first = pair_frame(8);
  const Seen resized = pair_frame(16);
  EXPECT_EQ(resized.state.reset, HistoryReset::description);
  EXPECT_NE(resized.previous, first.current);
  EXPECT_TRUE(pair_frame(16).state.valid());
  EXPECT_EQ(bytes_of_module("test"), 2u * 16 * 16 * 4);
}

// Hard case: passes.history_cut
TEST_F(HistoryTest, a_camera_cut_resets_only_for_owners_that_ask_for_it) {
  (void)pair_frame();
  view.cut_frame = view.frame;
  EXPECT_TRUE(pair_frame().state.valid());
  use.reset.camera_cut = true;
  EXPECT_TRUE(pair_frame().state.valid()) << "the cut came before the last write";
  view.cut_frame = view.frame;
  EXPECT_EQ(pair_frame().state.reset, HistoryReset::camera_cut);
  EXPECT_TRUE(pair_frame().state.valid());
}

TEST_F(HistoryTest, a_cut_in_a_frame_that_did_not_use_the_pair_still_resets) {
  use.reset.camera_cut = true;
  (void)pair_frame();
  view.cut_frame = view.frame;
  idle_frame();
  EXPECT_EQ(pair_frame().state.reset, HistoryReset::camera_cut);
}

// Hard case: passes.history_gap
TEST_F(HistoryTest, a_gap_longer_than_the_owner_allows_resets) {
  use.reset.most_missed = 2;
  (void)pair_frame();
  view.frame += 2;
  const HistoryState short_gap = pair_frame().state;
  EXPECT_TRUE(short_gap.valid());
  EXPECT_EQ(short_gap.age, 3u);
  view.frame += 3;
  const HistoryState long_gap = pair_frame().state;
  EXPECT_EQ(long_gap.reset, HistoryReset::gap);
  EXPECT_EQ(long_gap.age, 0u);
  EXPECT_TRUE(pair_frame().state.valid());
  use.reset.most_missed = 0;
  EXPECT_TRUE(pair_frame().state.valid());
  ++view.frame;
  EXPECT_EQ(pair_frame().state.reset, HistoryReset::gap);
}

TEST_F(HistoryTest, another_key_of_the_owner_resets) {
  use.reset.key = 7;
  (void)pair_frame();
  EXPECT_TRUE(pair_frame().state.valid());
  use.reset.key = 8;
  EXPECT_EQ(pair_frame().state.reset, HistoryReset::key);
  EXPECT_TRUE(pair_frame().state.valid());
}

TEST_F(HistoryTest, a_reset_lasts_until_a_frame_writes) {
  (void)pair_frame();
  use.reset.key = 1;
  for (int i = 0; i < 3; ++i) frame([&] { EXPECT_EQ(use_pair(8, false).state.reset, HistoryReset::key); });
  EXPECT_EQ(pair_frame().state.reset, HistoryReset::key);
  EXPECT_TRUE(pair_frame().state.valid());
}

class GivenUp : public HistoryTest, public ::testing::WithParamInterface<Lost> {};
INSTANTIATE_TEST_SUITE_P(While, GivenUp,
                         ::testing::Values(Lost::declaring, Lost::compiling, Lost::recording, Lost::submitting));

// Hard case: passes.history_given_up
TEST_P(GivenUp, a_frame_leaves_the_pair_as_it_was) {
  (void)pair_frame();
  const Seen before = pair_frame();
  for (int i = 0; i < 3; ++i) {
    const Seen lost = pair_frame(8, GetParam());
    EXPECT_TRUE(lost.state.valid());
    EXPECT_EQ(lost.state.age, 1u);
  }
  const Seen after = pair_frame();
  EXPECT_EQ(after.previous, before.current);
  EXPECT_EQ(after.current, before.previous);
  EXPECT_EQ(after.state.age, 1u);
}

// Hard case: passes.history_first
TEST_P(GivenUp, a_first_frame_leaves_nothing) {
  EXPECT_EQ(pair_frame(8, GetParam()).state.reset, HistoryReset::created);
  idle_frame();
  EXPECT_EQ(history.size(), 0u);
  EXPECT_EQ(bytes_of_module("test"), 0u);
  EXPECT_EQ(pair_frame().state.reset, HistoryReset::created);
}

TEST_P(GivenUp, a_resize_keeps_the_contents_of_the_old_size) {
  const Seen before = pair_frame(8);
  EXPECT_EQ(pair_frame(16, GetParam()).state.reset, HistoryReset::description);
  const Seen after = pair_frame(8);
  EXPECT_TRUE(after.state.valid());
  EXPECT_EQ(after.previous, before.current);
  EXPECT_EQ(bytes_of_module("test"), 2u * 8 * 8 * 4);
}

TEST_P(GivenUp, a_reset_is_told_again) {
  use.reset = {.camera_cut = true, .most_missed = 0, .key = 1};
  (void)pair_frame();
  const auto lost_and_again = [&](HistoryReset expected) {
    EXPECT_EQ(pair_frame(8, GetParam()).state.reset, expected);
    EXPECT_EQ(pair_frame().state.reset, expected);
    EXPECT_TRUE(pair_frame().state.valid());
  };
  use.reset.key = 2;
  lost_and_again(HistoryReset::key);
  view.cut_frame = view.frame;
  lost_and_again(HistoryReset::camera_cut);
  ++view.frame;
  lost_and_again(HistoryReset::gap);
}

TEST_P(GivenUp, a_simulation_in_place_does_not_step) {
  (void)knots_frame(1);
  const HistoryState lost = knots_frame(2, GetParam());
  EXPECT_TRUE(lost.valid());
  EXPECT_EQ(lost.age, 1u);
  const HistoryState after = knots_frame(3);
  EXPECT_TRUE(after.valid());
  EXPECT_EQ(after.age, 1u);
  EXPECT_FALSE(after.written);
}

TEST_P(GivenUp, a_frame_calls_no_commit_functions) {
  int calls = 0;
  frame([&] { history.on_commit([&] { ++calls; }); }, GetParam());
  idle_frame();
  EXPECT_EQ(calls, 0);
  frame([&] {
    history.on_commit([&] { ++calls; });
    EXPECT_EQ(calls, 0);
  });
  EXPECT_EQ(calls, 1);
  idle_frame();
  EXPECT_EQ(calls, 1);
}

TEST_F(HistoryTest, a_refused_creation_is_told_and_leaves_nothing_half_made) {
  frame([&] {
    device->fail_next_creation({ErrorKind::failed, "out of memory"});
    const auto made = history.image_pair(graph, view, temporal_desc(), use);
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().message, "out of memory");
  });
  EXPECT_EQ(history.size(), 0u);
  EXPECT_EQ(bytes_of_module("test"), 0u);
  const Seen kept = pair_frame(8);
  frame([&] {
    device->fail_next_creation({ErrorKind::failed, "out of memory"});
    EXPECT_FALSE(history.image_pair(graph, view, temporal_desc(16), use).ok());
  });
  EXPECT_EQ(pair_frame(8).previous, kept.current);
}

TEST_F(HistoryTest, worlds_views_and_instances_have_their_own) {
  const auto seen_by = [&](std::uint64_t world, std::uint32_t id, std::uint64_t instance) {
    view.world = world;
    view.view = id;
    use.instance = instance;
    return use_pair();
  };
  std::vector<gpu::ImageHandle> written;
  frame([&] {
    for (const std::uint64_t world : {1, 2})
      for (const std::uint32_t id : {0, 1})
        for (const std::uint64_t instance : {0, 5})
          EXPECT_EQ(seen_by(world, id, instance).state.reset, HistoryReset::created);
  });
  EXPECT_EQ(history.size(), 8u);
  frame([&] { EXPECT_TRUE(seen_by(1, 1, 5).state.valid()); });
  view.frame += 1;
  frame([&] { EXPECT_EQ(seen_by(2, 1, 5).state.age, 3u); });
}

TEST_F(HistoryTest, views_of_a_frame_share_what_belongs_to_the_world) {
  use.scope = HistoryScope::world;
  frame([&] {
    EXPECT_FALSE(use_knots(1).written);
    view.view = 1;
    const HistoryState second = use_knots(std::nullopt);
    EXPECT_TRUE(second.written);
    EXPECT_EQ(second.reset, HistoryReset::created);
    view.view = 2;
    EXPECT_TRUE(use_knots(2).written) << "the newest version is handed on";
  });
  EXPECT_EQ(history.size(), 1u);
  const HistoryState next = knots_frame(std::nullopt);
  EXPECT_TRUE(next.valid());
  EXPECT_FALSE(next.written);
}

TEST_F(HistoryTest, a_frame_that_is_drawn_again_gets_what_it_got_the_first_time) {
  (void)pair_frame();
  (void)pair_frame();
  view.cut_frame = view.frame;
  use.reset.camera_cut = true;
  const Seen once = pair_frame();
  for (int i = 0; i < 2; ++i) {
    --view.frame;
    const Seen again = pair_frame();
    EXPECT_EQ(again.previous, once.previous);
    EXPECT_EQ(again.current, once.current);
    EXPECT_EQ(again.state.reset, HistoryReset::camera_cut);
    EXPECT_TRUE(again.state.written);
  }
  const Seen next = pair_frame();
  EXPECT_EQ(next.previous, once.current);
  EXPECT_FALSE(next.state.written);
  EXPECT_TRUE(next.state.valid()) << "the frame after the cut";
}

TEST_F(HistoryTest, a_frame_that_is_drawn_again_with_another_key_writes_again) {
  (void)knots_frame(1);
  --view.frame;
  use.reset.key = 5;
  const HistoryState again = knots_frame(2);
  EXPECT_EQ(again.reset, HistoryReset::key);
  EXPECT_FALSE(again.filled());
  EXPECT_TRUE(knots_frame(std::nullopt).valid());
}

TEST_F(HistoryTest, resources_that_no_frame_uses_are_destroyed) {
  (void)pair_frame();
  for (std::uint64_t i = 0; i < History::kFramesKept; ++i) idle_frame();
  EXPECT_EQ(history.size(), 1u);
  idle_frame();
  EXPECT_EQ(history.size(), 0u);
  EXPECT_EQ(bytes_of_module("test"), 0u);
  EXPECT_EQ(pair_frame().state.reset, HistoryReset::created);
}

TEST_F(HistoryTest, frames_drawn_again_or_given_up_do_not_age_resources) {
  (void)pair_frame();
  for (std::uint64_t i = 0; i < 2 * History::kFramesKept; ++i) {
    frame([] {}, Lost::declaring);
    graph.begin();
    history.begin_frame();
    ASSERT_TRUE(graph.compile().ok());
    history.commit(graph, false);
  }
  EXPECT_EQ(history.size(), 1u);
}

TEST_F(HistoryTest, a_release_destroys_what_it_names_only) {
  const auto fill = [&] {
    frame([&] {
      for (const std::uint64_t world : {1, 2})
        for (const std::uint32_t id : {0, 1}) {
          view.world = world;
          view.view = id;
          (void)use_pair();
        }
      use.scope = HistoryScope::world;
      (void)use_knots(1);
      use.scope = HistoryScope::view;
    });
  };
  fill();
  ASSERT_EQ(history.size(), 5u);
  history.release_view(1);
  EXPECT_EQ(history.size(), 3u);
  fill();
  history.release_world(2);
  EXPECT_EQ(history.size(), 2u);
  EXPECT_EQ(bytes_of_module("test"), 2u * 2 * 8 * 8 * 4);
  history.release_module("other");
  EXPECT_EQ(history.size(), 2u);
  history.release_module("test");
  EXPECT_EQ(history.size(), 0u);
  EXPECT_EQ(bytes_of_module("test"), 0u);
}

TEST_F(HistoryTest, what_views_share_goes_with_the_last_of_them) {
  use.scope = HistoryScope::shared;
  frame([&] {
    for (const auto& [id, instance] : {std::pair(1u, 5u), {2u, 5u}, {3u, 6u}}) {
      view.view = id;
      use.instance = instance;
      EXPECT_EQ(use_knots(1).written, id == 2);
    }
  });
  for (const auto& [released, left] : {std::pair(2u, 2u), {2u, 2u}, {1u, 1u}, {3u, 0u}}) {
    history.release_view(released);
    EXPECT_EQ(history.size(), left) << released;
  }
}

TEST_F(HistoryTest, a_release_in_the_middle_of_a_frame_forgets_the_use) {
  (void)pair_frame();
  graph.begin();
  history.begin_frame();
  (void)history.image_pair(graph, view, temporal_desc(16), use).value();
  history.release_module("test");
  ASSERT_TRUE(graph.compile().ok());
  history.commit(graph);
  EXPECT_EQ(history.size(), 0u);
  EXPECT_EQ(bytes_of_module("test"), 0u);
}

TEST_F(HistoryTest, misuse_asserts) {
  graph.begin();
  history.begin_frame();
  ASSERT_TRUE(history.image_pair(graph, view, temporal_desc(), use).ok());
  EXPECT_ASSERT((void)history.image_pair(graph, view, temporal_desc(16), use), "one description");
  EXPECT_ASSERT((void)history.image(graph, view, temporal_desc(), use), "one description");
  use.scope = HistoryScope::world;
  use.reset.camera_cut = true;
  EXPECT_ASSERT((void)history.buffer(graph, view, knots_desc(), use), "only a view");
  use = {.final_access = Access::transfer_write};
  EXPECT_ASSERT((void)history.buffer(graph, view, knots_desc(), use), "access that reads");
}

}  // namespace
}  // namespace gloam::test
