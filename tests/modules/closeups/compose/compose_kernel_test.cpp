// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "engine/math/packing.h"
#include "engine/render/camera/view_constants.h"
#include "engine/render/view.h"
#include "modules/shadows/views/cascade_rows.h"
#include "shaders/closeups/closeups_shared.h"
#include "shaders/closeups/shaders.h"
#include "shaders/lights/lights_shared.h"
#include "shaders/shadows/final_lists_shared.h"
#include "tests/modules/closeups/compose/compose_cases.h"
#include "tests/modules/shadows/rig.h"
#include "tests/modules/shadows/support/final_lists/kernels.h"
#include "tests/modules/shadows/support/maps.h"

// Runs tiles_….comp and compose_….comp on a wall with synthetic lists, and compares with a model in double.

namespace gloam {
namespace {

using test::FacePose;
using test::kGuard;
using namespace test::compose;

class ComposeCloseup : public test::ShadowKernelTest {
 protected:
  static gpu::ShaderCode code_of(const Settings& s) {
    using namespace shaders::closeups;
    if (s.directional) return s.standard ? compose_suns_standard_comp : compose_suns_comp;
    return s.standard ? compose_local_standard_comp : compose_local_comp;
  }
  /// What both kernels read.
  struct Inputs {
    Inputs(gpu::Device& device, const Wall& wall, const Pair& pair, const Settings& s, const Lists& lists)
        : maps(device, 2 * kFace), view{view_constants(wall.view)} {
      maps.add_face(pair.depths, uvec2(kFace, 0), kFace, s.directional);
      grid[0].tiles = Wall::tiles();
      grid[0].slot_capacity = s.slots_left ? lists.end_slot + *s.slots_left : 1u << 22;
      block[0] = test::shadow_block(maps);
      append_cascade_rows({}, block[0], rows);
      lights[3 * kLight] = vec4(vec3(pair.pose.origin), 1.0f / 400.0f);
      lights[3 * kLight + 1] = vec4(5.0f, 5.0f, 5.0f, 0.0f);
      lights[3 * kLight + 2] = vec4(0.0f, 0.0f, -1.0f, 1.0f);
    }
    void bind(test::ListDispatch& d, const Pair& pair) const {
      const std::vector<std::uint32_t> white(1, ~0u);
      d.input(0, view);
      d.input(1, std::vector{pair.constants});
      d.input(2, grid);
      d.sampled(6, gpu::Format::rgba32_float, {3, 64}, lights);
      d.input(12, block);
      d.sampled(13, gpu::Format::rgba32_float, {GLOAM_SHADOW_ROW_TEXELS, static_cast<std::uint32_t>(rows.size())},
                rows);
      d.sampled(14, maps.atlas_image());
      d.sampled(15, maps.pyramid_image());
      d.sampled(16, gpu::Format::rgba8_unorm, {1, 1}, white, gpu::ImageShape::array);
      d.sampled(17, gpu::Format::rgba8_unorm, {1, 1}, white, gpu::ImageShape::array);
    }
    test::ShadowMaps maps;
    std::vector<shaders::ViewConstants> view;
    std::vector<shaders::FinalGrid> grid{1};
    std::vector<shaders::ShadowBlock> block{1};
    std::vector<shaders::ShadowRow> rows{1};
    std::vector<vec4> lights{std::size_t{3} * 64, vec4(0.0f)};
  };
  void run(test::ListDispatch& d, gpu::ShaderCode code, const gpu::SpecConstants& constants, uvec2 groups) {
    const auto pipeline =
        test::value_of(device().create_pipeline(gpu::ComputePipelineDesc{"closeup", "test", code, constants}));
    d.run(pipeline, groups);
    device().destroy(pipeline);
  }
  static test::ProbeSettings filter_of(const Settings& s) {
    return {.filter = s.standard ? 3u : 0u, .levels = (1u << s.bits) - 1, .standard = s.standard};
  }

  /// The listed tiles of a pair, and its indirect command.
  struct PairTiles {
    std::vector<uvec4> commands{4, uvec4(0)};
    std::vector<uvec2> items;
  };
  /// Runs the kernel that lists tiles.
  PairTiles list_tiles(const Inputs& inputs, const Wall& wall, const Pair& pair, const Settings& s, Lists& lists,
                       bool has_anew) {
    using namespace shaders::closeups;
    PairTiles tiles;
    tiles.items.assign(pair.constants.first_item + lists.tiles.size() + 1, uvec2(kGuard));
    test::ListDispatch d(device());
    inputs.bind(d, pair);
    d.sampled(3, gpu::Format::rg32_float, Wall::tiles(), wall.bounds);
    d.sampled(7, gpu::Format::rgba32_uint, Wall::tiles(), lists.tiles);
    d.input(8, lists.entries);
    d.input(9, lists.kept);
    d.in_out(10, tiles.commands);
    d.in_out(11, tiles.items);
    d.push(has_anew ? 1u : 0u);
    run(d, s.directional ? tiles_suns_comp : tiles_local_comp, filter_of(s).constants(),
        (Wall::end() - Wall::first() + 7u) / 8u);
    const std::size_t first = pair.constants.first_item, count = tiles.commands[pair.constants.pair].w;
    EXPECT_EQ(std::ranges::count(tiles.items, uvec2(kGuard)), std::ptrdiff_t(tiles.items.size() - count));
    std::sort(tiles.items.begin() + std::ptrdiff_t(first), tiles.items.begin() + std::ptrdiff_t(first + count),
              [](uvec2 a, uvec2 b) { return a.x < b.x; });
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_NE(tiles.items[first + i].x, i == 0 ? kGuard : tiles.items[first + i - 1].x) << "listed twice";
    return tiles;
  }
  void compose(const Wall& wall, const Pair& pair, const Settings& s, Lists& lists) {
    const Inputs inputs(device(), wall, pair, s, lists);
    PairTiles tiles = list_tiles(inputs, wall, pair, s, lists, false);
    const uvec4 command = tiles.commands[pair.constants.pair];
    ASSERT_EQ(command, uvec4(GLOAM_PAIRS_ROW, (command.w + GLOAM_PAIRS_ROW - 1) / GLOAM_PAIRS_ROW, 1, command.w));
    test::ListDispatch d(device());
    inputs.bind(d, pair);
    d.sampled(3, gpu::Format::r32_float, Wall::size(), wall.depth);
    d.sampled(4, gpu::Format::rg32_uint, Wall::size(), wall.normals);
    d.sampled(5, gpu::Format::rgba8_unorm, Wall::size(), wall.base_color);
    d.storage_image(7, gpu::Format::rgba32_uint, Wall::tiles(), lists.tiles);
    d.in_out(8, lists.entries);
    d.in_out(9, lists.words[0]);
    d.in_out(10, lists.words[1]);
    d.in_out(11, lists.counters);
    d.in_out(18, lists.commands);
    d.in_out(19, lists.fallback);
    d.input(20, tiles.commands);
    d.sampled(21, gpu::Format::rg32_uint, {1, 1}, std::vector<uvec2>(1));     // not read: no terminator
    d.sampled(22, gpu::Format::rgba16_float, {1, 1}, std::vector<uvec2>(1));  // not read: no light passes through
    d.in_out(23, lists.kept);
    d.input(24, tiles.items);
    auto constants = filter_of(s).constants();
    constants.set("local_size_x", s.threads);
    constants.set("kVisibilityBits", s.bits);
    constants.set("kReuse", 1u);
    run(d, code_of(s), constants, uvec2(command));
  }

  struct Tally {
    std::size_t untouched = 0, new_slots = 0, kept_slots = 0, lit_to_unlit = 0, slot_to_unlit = 0, given_up = 0;
    std::size_t either = 0, pixels = 0;
    std::set<std::uint32_t> taken;
  };
  /// Allowed outcomes for a tile's entry.
  struct Outcome {
    bool must_change = false, may_change = false, must_stay = false,
         may_stay = false;  ///< stay: some pixel still sees the light
  };

  /// Runs the kernel and checks everything that it may write.
  Tally expect_composed(const Settings& s, std::uint32_t seed, bool split = false) {
    std::mt19937 random(seed);
    const Wall wall = make_wall(seed);
    const Pair pair = make_pair(s);
    Lists before = make_lists(s, random, split), after = before;
    compose(wall, pair, s, after);
    Tally tally;
    std::vector<std::uint32_t> entries = before.entries;  // expected entries
    for (std::uint32_t tile = 0; tile < before.tiles.size() && !HasFailure(); ++tile) {
      SCOPED_TRACE("tile " + std::to_string(tile));
      check_tile(wall, pair, s, tile, before, after, tally, entries);
      check_kept(s, tile, before, after);
    }
    if (HasFailure()) return tally;
    check_words(s, before, after, tally);
    EXPECT_EQ(after.entries, entries) << "entries of other lights";
    EXPECT_EQ(after.counters[0].slots, before.end_slot + tally.new_slots + tally.given_up);
    EXPECT_EQ(after.counters[0].fallback_tiles, tally.given_up);
    EXPECT_EQ(after.commands[0].fallback_draw.y, tally.given_up);
    EXPECT_EQ(tally.taken.size(), tally.new_slots);
    if (!tally.taken.empty()) {
      EXPECT_EQ(*tally.taken.begin(), before.end_slot);
      EXPECT_EQ(*tally.taken.rbegin(), before.end_slot + tally.new_slots - 1);
    }
    return tally;
  }
  void check_tile(const Wall& wall, const Pair& pair, const Settings& s, std::uint32_t tile, Lists& before,
                  Lists& after, Tally& tally, std::vector<std::uint32_t>& entries) {
    const uvec4 texel = before.tiles[tile];
    std::optional<std::size_t> place;
    if (texel.y != GLOAM_NO_FINAL_LIST && Wall::covers(tile)) {
      const std::uint32_t first = s.directional ? texel.x : texel.y;
      const std::uint32_t count = s.directional ? texel.z >> 16 : texel.z & 0xFFFFu;
      for (std::uint32_t i = 0; i < count; ++i)
        if ((before.entries[first + i] & 1023u) == kLight) place = first + i;
    }
    const std::uint32_t old_slot = place ? before.entries[*place] >> 10 : GLOAM_ALL_UNLIT;
    if (old_slot == GLOAM_ALL_UNLIT) {
      ++tally.untouched;
      EXPECT_EQ(after.tiles[tile], texel);
      return;
    }
    const Outcome outcome = outcome_of(wall, pair, s, tile, old_slot, before);
    if (after.tiles[tile] != texel) {
      EXPECT_TRUE(s.slots_left.has_value() && old_slot == GLOAM_ALL_LIT && outcome.may_change && outcome.may_stay);
      EXPECT_EQ(after.tiles[tile], uvec4(GLOAM_NO_FINAL_LIST, GLOAM_NO_FINAL_LIST, 0, 0));
      const std::uint32_t word = tile / Wall::tiles().x << 16 | tile % Wall::tiles().x;
      EXPECT_EQ(std::ranges::count(after.fallback, word), 1);
      ++tally.given_up;
      return;
    }
    const std::uint32_t slot = after.entries[*place] >> 10;
    EXPECT_EQ(after.entries[*place] & 1023u, kLight);
    entries[*place] = after.entries[*place];
    if (slot == GLOAM_ALL_UNLIT) {
      EXPECT_TRUE(outcome.may_change && !outcome.must_stay);
      ++(old_slot == GLOAM_ALL_LIT ? tally.lit_to_unlit : tally.slot_to_unlit);
      return;
    }
    if (slot == GLOAM_ALL_LIT) {
      EXPECT_EQ(old_slot, GLOAM_ALL_LIT);
      EXPECT_FALSE(outcome.must_change);
      return;
    }
    if (old_slot == GLOAM_ALL_LIT) {
      EXPECT_TRUE(outcome.may_change && outcome.may_stay);
      ++tally.new_slots;
      EXPECT_TRUE(tally.taken.insert(slot).second);
      ASSERT_GE(slot, before.end_slot);
    } else {
      ASSERT_EQ(slot, old_slot);
      // A slot whose pixels are all unlit already stays as it is. Otherwise a changed slot still has a lit pixel.
      EXPECT_TRUE(!outcome.must_change || outcome.may_stay);
      ++tally.kept_slots;
    }
    check_pixels(wall, pair, s, tile, old_slot, slot, before, after, tally);
  }
  /// Tiles note for the next frame that the light is composed, if anything of it has changed. Fallback tiles are not
  /// kept.
  static void check_kept(const Settings& s, std::uint32_t tile, Lists& before, Lists& after) {
    const uvec4 texel = before.tiles[tile];
    bool changed = after.tiles[tile] != texel;
    const std::uint32_t counts[] = {texel.z >> 16, texel.z & 0xFFFFu}, firsts[] = {texel.x, texel.y};
    for (int run = 0; run < 2; ++run)
      for (std::uint32_t i = 0; i < counts[run]; ++i) {
        const std::uint32_t entry = before.entries[firsts[run] + i], slot = entry >> 10;
        changed = changed || after.entries[firsts[run] + i] != entry;
        for (std::uint32_t word = 0; slot < GLOAM_NO_ROOM && word < 2 * s.bits; ++word)
          changed = changed || after.word(s, slot, word) != before.word(s, slot, word);
      }
    const shaders::KeptTile& kept = after.kept[tile];
    const bool given_up = after.tiles[tile] != texel;
    const std::uint32_t bit = s.directional ? 1u << (28 + kLight % 4) : 1u << kLight % 28;
    EXPECT_EQ(kept.local_first, given_up ? GLOAM_NO_FINAL_LIST : 3u);
    EXPECT_EQ(kept.composed, changed ? 5u | bit : 5u);
    EXPECT_EQ(uvec4(kept.key.x, kept.directional_first, kept.counts, kept.anew), uvec4(1, 2, 4, 6));
  }
  static std::uint32_t old_steps(const Settings& s, std::uint32_t slot, std::uint32_t pixel, Lists& before) {
    return slot == GLOAM_ALL_LIT ? (1u << s.bits) - 1 : before.steps(s, slot, pixel);
  }
  static std::optional<std::size_t> surface(const Wall& wall, std::uint32_t tile, std::uint32_t pixel) {
    const uvec2 at = uvec2(tile % Wall::tiles().x, tile / Wall::tiles().x) * 8u + uvec2(pixel & 7u, pixel >> 3);
    if (at.x >= Wall::kWidth || at.y >= Wall::kHeight) return std::nullopt;
    const std::size_t i = std::size_t{at.y} * Wall::kWidth + at.x;
    return wall.depth[i] > 0.0f ? std::optional(i) : std::nullopt;
  }
  static Outcome outcome_of(const Wall& wall, const Pair& pair, const Settings& s, std::uint32_t tile,
                            std::uint32_t slot, Lists& before) {
    Outcome outcome;
    for (std::uint32_t pixel = 0; pixel < 64; ++pixel) {
      const auto at = surface(wall, tile, pixel);
      if (!at || old_steps(s, slot, pixel, before) == 0) continue;
      const Says says = says_of(pair, s, wall.points[*at]);
      outcome.must_change |= says == Says::unlit;
      outcome.may_change |= says == Says::unlit || says == Says::either;
      outcome.must_stay |= says == Says::lit || says == Says::aside;
      outcome.may_stay |= says != Says::unlit;
    }
    return outcome;
  }
  static void check_pixels(const Wall& wall, const Pair& pair, const Settings& s, std::uint32_t tile,
                           std::uint32_t old_slot, std::uint32_t slot, Lists& before, Lists& after, Tally& tally) {
    for (std::uint32_t pixel = 0; pixel < 64; ++pixel) {
      const auto at = surface(wall, tile, pixel);
      if (!at) continue;
      const std::uint32_t old = old_steps(s, old_slot, pixel, before), now = after.steps(s, slot, pixel);
      const Says says = says_of(pair, s, wall.points[*at]);
      ++tally.pixels;
      tally.either += says == Says::either ? 1 : 0;
      if (says == Says::either) {
        EXPECT_LE(now, old) << "pixel " << pixel;
      } else {
        EXPECT_EQ(now, says == Says::unlit ? 0u : old) << "pixel " << pixel;
      }
    }
  }
  /// Checks that slots of other entries and words beyond all slots are unchanged.
  static void check_words(const Settings& s, Lists& before, Lists& after, const Tally& tally) {
    std::set<std::uint32_t> own = tally.taken;
    const auto count = static_cast<std::uint32_t>(before.tiles.size());
    for (std::uint32_t tile = 0; tile < count; ++tile) {
      if (before.tiles[tile].y == GLOAM_NO_FINAL_LIST || !Wall::covers(tile)) continue;
      const std::uint32_t first = s.directional ? before.tiles[tile].x : before.tiles[tile].y;
      const std::uint32_t entries = s.directional ? before.tiles[tile].z >> 16 : before.tiles[tile].z & 0xFFFFu;
      for (std::uint32_t i = 0; i < entries; ++i)
        if ((before.entries[first + i] & 1023u) == kLight) own.insert(before.entries[first + i] >> 10);
    }
    std::size_t written = 0;
    for (std::uint32_t slot = s.first_slot; slot < before.end_slot + count; ++slot)
      for (std::uint32_t i = 0; i < 2 * s.bits && !own.contains(slot); ++i)
        written += after.word(s, slot, i) == before.word(s, slot, i) ? 0 : 1;
    EXPECT_EQ(written, 0u) << "words of slots that are not the pair's";
  }
};

TEST_F(ComposeCloseup, takes_the_lesser_of_what_pixels_saw_and_what_the_subject_leaves) {
  Tally sum;
  std::uint32_t seed = 1;
  for (const bool directional : {false, true})
    for (const std::uint32_t bits : {8u, 4u})
      for (const std::uint32_t threads : {8u, 16u, 32u, 64u}) {
        SCOPED_TRACE(std::string(directional ? "sun " : "lamp ") + std::to_string(bits) + " bits, " +
                     std::to_string(threads) + " threads");
        const Tally tally = expect_composed({.directional = directional, .bits = bits, .threads = threads}, seed++);
        if (HasFailure()) return;
        sum.untouched += tally.untouched, sum.new_slots += tally.new_slots, sum.kept_slots += tally.kept_slots;
        sum.lit_to_unlit += tally.lit_to_unlit, sum.slot_to_unlit += tally.slot_to_unlit;
        sum.either += tally.either, sum.pixels += tally.pixels;
        EXPECT_EQ(tally.given_up, 0u);
      }
  EXPECT_GT(sum.untouched, 200u);
  EXPECT_GT(sum.new_slots, 40u);
  EXPECT_GT(sum.kept_slots, 40u);
  EXPECT_GT(sum.lit_to_unlit, 3u);
  EXPECT_GT(sum.slot_to_unlit, 3u);
  EXPECT_LT(sum.either * 20, sum.pixels) << "nearly all pixels are certain";
}

TEST_F(ComposeCloseup, with_the_standard_filter_is_certain_away_from_silhouettes) {
  std::uint32_t seed = 101;
  for (const bool directional : {false, true})
    for (const std::uint32_t bits : {8u, 4u}) {
      const Tally tally =
          expect_composed({.directional = directional, .standard = true, .bits = bits, .threads = 32}, seed++);
      EXPECT_GT(tally.new_slots + tally.kept_slots, 2u);
      if (HasFailure()) return;
    }
}

TEST_F(ComposeCloseup, again_changes_nothing) {
  for (const bool directional : {false, true}) {
    const Settings s{.directional = directional, .threads = 32};
    std::mt19937 random(31);
    const Wall wall = make_wall(31);
    const Pair pair = make_pair(s);
    Lists once = make_lists(s, random, false);
    const Lists before = once;
    compose(wall, pair, s, once);
    EXPECT_NE(once.entries, before.entries);
    Lists twice = once;
    compose(wall, pair, s, twice);
    EXPECT_EQ(twice.entries, once.entries);
    EXPECT_EQ(twice.words, once.words);
    EXPECT_EQ(twice.tiles, once.tiles);
    EXPECT_EQ(twice.counters[0].slots, once.counters[0].slots);
  }
}

TEST_F(ComposeCloseup, looks_only_at_tiles_whose_light_is_not_composed_already) {
  for (const bool directional : {false, true}) {
    const Settings s{.directional = directional};
    std::mt19937 random(41);
    const Wall wall = make_wall(41);
    const Pair pair = make_pair(s);
    Lists lists = make_lists(s, random, false);
    const std::uint32_t bit = directional ? 1u << (28 + kLight % 4) : 1u << kLight % 28;
    for (shaders::KeptTile& kept : lists.kept) kept.anew = random() % 2 == 0 ? ~bit : bit;
    const Inputs inputs(device(), wall, pair, s, lists);
    const PairTiles all = list_tiles(inputs, wall, pair, s, lists, false);
    const PairTiles some = list_tiles(inputs, wall, pair, s, lists, true);
    std::vector<uvec2> expected(pair.constants.first_item, uvec2(kGuard));
    for (std::size_t i = pair.constants.first_item; all.items[i].x != kGuard; ++i)
      if (lists.kept[(all.items[i].x >> 16) * Wall::tiles().x + (all.items[i].x & 0xFFFFu)].anew == bit)
        expected.push_back(all.items[i]);
    const std::size_t count = expected.size() - pair.constants.first_item;
    EXPECT_GT(count, 2u);
    EXPECT_LT(count, all.commands[pair.constants.pair].w);
    EXPECT_EQ(some.commands[pair.constants.pair].w, count);
    expected.resize(some.items.size(), uvec2(kGuard));
    EXPECT_EQ(some.items, expected);
  }
}

TEST_F(ComposeCloseup, without_a_slot_gives_the_tile_up_and_says_so) {
  std::size_t given_up = 0, new_slots = 0;
  for (const std::uint32_t left : {0u, 1u, 3u}) {
    const Tally tally = expect_composed({.threads = 16, .slots_left = left}, 7);
    if (HasFailure()) return;
    EXPECT_LE(tally.new_slots, left);
    EXPECT_TRUE(tally.new_slots == left || tally.given_up == 0);
    given_up += tally.given_up, new_slots += tally.new_slots;
  }
  EXPECT_GT(given_up, 3u);
  EXPECT_GT(new_slots, 1u);
}

TEST_F(ComposeCloseup, reads_and_writes_slots_of_both_buffers) {
  constexpr std::uint32_t kPerBuffer = GLOAM_BUFFER_WORDS / 16;
  Settings s{.threads = 64, .first_slot = kPerBuffer - 300};
  const Tally tally = expect_composed(s, 9, true);
  EXPECT_GT(tally.kept_slots, 4u);
  EXPECT_GT(tally.new_slots, 2u);
}

}  // namespace
}  // namespace gloam
