// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "shaders/shadows/final_lists_shared.h"
#include "shaders/shadows/shaders.h"
#include "tests/modules/shadows/support/final_lists/kernels.h"
#include "tests/support/kernel.h"
#include "tests/support/scale.h"

// Compares finish.comp with lists that the CPU finishes.

namespace gloam {
namespace {

using test::kGuard;

/// A tile's unfinished list.
struct OpenList {
  bool has_list = true;
  std::vector<std::uint32_t> directional, local;  ///< entries
};

struct OpenLists {
  uvec2 size;
  std::uint32_t directional_count = 0;
  std::vector<OpenList> tiles;
};

struct Finished {
  std::vector<uvec4> texels;
  std::vector<std::uint32_t> entries, fallback;
  std::vector<shaders::ShadowListCounters> counters{1};
  std::vector<shaders::ShadowListCommands> commands{1};
  std::vector<std::uint32_t> entries_before;
};

class FinishLists : public test::KernelTest {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(KernelTest::SetUp());
    if (IsSkipped()) return;
    pipeline_ = test::value_of(
        device().create_pipeline(gpu::ComputePipelineDesc{"finish_lists", "test", shaders::shadows::finish_comp, {}}));
  }
  void TearDown() override {
    if (pipeline_) device().destroy(pipeline_);
    KernelTest::TearDown();
  }

  /// Runs finish.comp. The runs of directional entries are in tile order; those of local entries are in random order,
  /// with gaps.
  Finished finish(const OpenLists& lists, std::mt19937& random) const {
    Finished f;
    const std::size_t count = lists.tiles.size();
    f.entries.assign(count * lists.directional_count, kGuard);
    std::vector<std::size_t> order(count);
    for (std::size_t i = 0; i < count; ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), random);
    f.texels.assign(count, uvec4(GLOAM_NO_FINAL_LIST, GLOAM_NO_FINAL_LIST, 0, 0));
    for (const std::size_t i : order) {
      const OpenList& list = lists.tiles[i];
      if (!list.has_list) continue;
      const std::size_t first = i * lists.directional_count;
      std::copy(list.directional.begin(), list.directional.end(),
                f.entries.begin() + static_cast<std::ptrdiff_t>(first));
      f.entries.resize(f.entries.size() + random() % 4, kGuard);
      f.texels[i] = {first, f.entries.size(), list.directional.size() << 16 | list.local.size(), 0};
      f.entries.insert(f.entries.end(), list.local.begin(), list.local.end());
    }
    f.entries.resize(f.entries.size() + 3, kGuard);
    f.entries_before = f.entries;
    f.fallback.assign(count + 1, kGuard);
    f.commands[0].fallback_draw = {6, 0, 0, 0};
    shaders::FinalGrid grid{};
    grid.tiles = lists.size;
    grid.directional_count = lists.directional_count;
    grid.entry_capacity = static_cast<std::uint32_t>(f.entries.size());
    test::ListDispatch dispatch(device());
    dispatch.input(0, std::vector{grid});
    dispatch.storage_image(1, gpu::Format::rgba32_uint, lists.size, f.texels);
    dispatch.in_out(2, f.entries);
    dispatch.in_out(3, f.fallback);
    dispatch.in_out(4, f.counters);
    dispatch.in_out(5, f.commands);
    dispatch.run(pipeline_, (lists.size + 7u) / 8u);
    return f;
  }

  static bool no_room(const OpenList& list) {
    const auto full = [](std::uint32_t entry) { return entry >> 10 == GLOAM_NO_ROOM; };
    return std::any_of(list.directional.begin(), list.directional.end(), full) ||
           std::any_of(list.local.begin(), list.local.end(), full);
  }
  static std::vector<std::uint32_t> kept(std::vector<std::uint32_t> run) {
    std::erase_if(run, [](std::uint32_t entry) { return entry >> 10 == GLOAM_ALL_UNLIT; });
    return run;
  }
  static std::vector<std::uint32_t> part(const std::vector<std::uint32_t>& words, std::size_t first,
                                         std::size_t count) {
    const auto begin = words.begin() + static_cast<std::ptrdiff_t>(first);
    return {begin, begin + static_cast<std::ptrdiff_t>(count)};
  }
  static void expect_right(const OpenLists& lists, const Finished& f) {
    std::vector<std::uint32_t> incomplete;
    for (std::size_t i = 0; i < lists.tiles.size(); ++i) {
      const OpenList& list = lists.tiles[i];
      const uvec4 t = f.texels[i];
      const std::size_t first = i * lists.directional_count;
      if (!list.has_list || no_room(list)) {
        EXPECT_EQ(uvec3(t), uvec3(GLOAM_NO_FINAL_LIST, GLOAM_NO_FINAL_LIST, 0)) << "tile " << i;
        incomplete.push_back(static_cast<std::uint32_t>(i / lists.size.x << 16 | i % lists.size.x));
        continue;
      }
      const auto directional = kept(list.directional), local = kept(list.local);
      ASSERT_EQ(t.z, directional.size() << 16 | local.size()) << "tile " << i;
      EXPECT_EQ(t.x, first);
      EXPECT_EQ(part(f.entries, t.x, directional.size()), directional) << "tile " << i;
      EXPECT_EQ(part(f.entries, t.y, local.size()), local) << "tile " << i;
    }
    // Entries that belong to no tile are unchanged.
    for (std::size_t e = 0; e < f.entries.size(); ++e)
      EXPECT_TRUE(f.entries_before[e] != kGuard || f.entries[e] == kGuard) << "entry " << e;
    ASSERT_EQ(f.commands[0].fallback_draw, uvec4(6, incomplete.size(), 0, 0));
    EXPECT_EQ(f.counters[0].fallback_tiles, incomplete.size());
    auto named = part(f.fallback, 0, incomplete.size());
    std::sort(named.begin(), named.end());
    EXPECT_EQ(named, incomplete);
    EXPECT_EQ(f.fallback[incomplete.size()], kGuard);
  }

  gpu::PipelineHandle pipeline_;
};

std::vector<std::uint32_t> random_run(std::mt19937& random, std::size_t most, std::uint32_t full_in) {
  std::vector<std::uint32_t> run;
  for (std::uint32_t light = 0; light < 1024 && run.size() < most; ++light) {
    if (random() % 3 != 0) continue;
    const std::uint32_t slots[] = {GLOAM_ALL_LIT,     GLOAM_ALL_UNLIT,
                                   GLOAM_ALL_UNLIT,   0u,
                                   GLOAM_NO_ROOM - 1, static_cast<std::uint32_t>(random() % 5000)};
    const bool full = full_in != 0 && random() % full_in == 0;
    run.push_back(light | (full ? GLOAM_NO_ROOM : slots[random() % 6]) << 10);
    if (random() % (most + 1) == 0) break;
  }
  return run;
}

TEST_F(FinishLists, keep_what_some_pixel_needs_in_order_and_name_tiles_without_room) {
  const uvec2 sizes[] = {{1, 1}, {7, 5}, {8, 8}, {9, 17}, {33, 20}};
  for (int seed = 0; seed < test::scaled(40); ++seed) {
    std::mt19937 random(static_cast<std::uint32_t>(seed));
    OpenLists lists;
    lists.size = sizes[seed % 5];
    lists.directional_count = seed % 4 == 0 ? 0 : static_cast<std::uint32_t>(random() % 17);
    lists.tiles.resize(lists.size.x * lists.size.y);
    const std::uint32_t full_in[] = {0, 200, 20, 2};
    for (OpenList& list : lists.tiles) {
      list.has_list = seed % 3 == 0 || random() % 9 != 0;
      if (!list.has_list || random() % 5 == 0) continue;
      list.directional = random_run(random, lists.directional_count, full_in[seed / 5 % 4]);
      list.local = random_run(random, random() % 60, full_in[seed / 5 % 4]);
    }
    const Finished f = finish(lists, random);
    expect_right(lists, f);
    if (HasFailure()) FAIL() << "seed " << seed;
  }
}

// Hard case: shadows.lights_1024
TEST_F(FinishLists, of_1024_lights_in_a_tile_lose_none) {
  std::mt19937 random(5);
  OpenLists lists{.size = {2, 1}, .directional_count = 16, .tiles = {2, OpenList{}}};
  for (std::uint32_t light = 0; light < 1024; ++light) {
    lists.tiles[0].local.push_back(light | (light % 3 == 0 ? GLOAM_ALL_UNLIT : light * 4000) << 10);
    lists.tiles[1].local.push_back(light | GLOAM_ALL_UNLIT << 10);
  }
  for (std::uint32_t light = 0; light < 16; ++light) lists.tiles[1].directional.push_back(light | GLOAM_ALL_LIT << 10);
  expect_right(lists, finish(lists, random));
}

TEST_F(FinishLists, of_tiles_that_all_find_no_room_are_all_drawn_otherwise) {
  std::mt19937 random(9);
  OpenLists lists{.size = {13, 11}, .directional_count = 1, .tiles = std::vector<OpenList>(143)};
  for (OpenList& list : lists.tiles) list.directional = {GLOAM_NO_ROOM << 10};
  expect_right(lists, finish(lists, random));
}

}  // namespace
}  // namespace gloam
