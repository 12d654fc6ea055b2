// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/final_lists/buffers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/view_frames.h"

namespace gloam {
namespace {

using test::view_at;

constexpr std::uint32_t kMost = 4194301;  // slots that 22 bits can number beside the three special values

TEST(KeptCapacity, has_room_for_what_is_asked_and_a_quarter_more) {
  EXPECT_EQ(kept_capacity(0, 1000, 0, kMost), 1250u);
  EXPECT_EQ(kept_capacity(999, 1000, 0, kMost), 1250u);
  EXPECT_EQ(kept_capacity(0, 0, 0, kMost), 0u);
}

TEST(KeptCapacity, stays_while_it_is_enough_and_not_four_times_too_large) {
  EXPECT_EQ(kept_capacity(1250, 1000, 0, kMost), 1250u);
  EXPECT_EQ(kept_capacity(1250, 1250, 0, kMost), 1250u);
  EXPECT_EQ(kept_capacity(1250, 300, 0, kMost), 1250u);
  EXPECT_EQ(kept_capacity(1250, 100, 0, kMost), 125u);
}

TEST(KeptCapacity, is_never_less_than_the_least_nor_more_than_the_most) {
  EXPECT_EQ(kept_capacity(0, 10, 500, kMost), 500u);
  EXPECT_EQ(kept_capacity(100, 10, 500, kMost), 500u);
  EXPECT_EQ(kept_capacity(0, kMost, 0, kMost), kMost);
  EXPECT_EQ(kept_capacity(0, ~0u, 0, kMost), kMost);
  EXPECT_EQ(kept_capacity(~0u, ~0u, ~0u, kMost), kMost);
}

TEST(KeptCapacity, of_any_numbers_is_enough_within_bounds_and_settles_at_once) {
  std::mt19937 random(7);
  for (int i = 0; i < 20000; ++i) {
    const auto number = [&] { return static_cast<std::uint32_t>(random() >> random() % 32); };
    const std::uint32_t there = number(), asked = number(), most = number(), least = std::min(number(), most);
    const std::uint32_t kept = kept_capacity(there, asked, least, most);
    EXPECT_LE(kept, most);
    EXPECT_GE(kept, least);
    EXPECT_GE(kept, std::min(asked, most));
    EXPECT_EQ(kept_capacity(kept, asked, least, most), kept) << there << ' ' << asked << ' ' << least << ' ' << most;
    // A need that varies by a tenth does not change the capacity.
    if (asked < 1000 || asked > most / 2) continue;
    const std::uint32_t made = kept_capacity(0, asked, least, most);
    EXPECT_EQ(kept_capacity(made, asked + asked / 10, least, most), made) << asked << ' ' << least << ' ' << most;
    EXPECT_EQ(kept_capacity(made, asked - asked / 10, least, most), made) << asked << ' ' << least << ' ' << most;
  }
}

shaders::ShadowListCounters counters_of(std::uint32_t pairs, std::uint32_t slots) {
  shaders::ShadowListCounters counters{};
  counters.pairs = pairs;
  counters.slots = slots;
  return counters;
}

TEST(FinalListFeedback, asks_for_what_the_frame_asked_for) {
  const FinalListNote note{.tiles = 10, .slot_capacity = 100, .pair_capacity = 200};
  const FinalListFeedback feedback = final_list_feedback(counters_of(150, 80), note, nullptr);
  EXPECT_EQ(feedback.pairs_asked, 150u);
  EXPECT_EQ(feedback.slots_asked, 80u);
  EXPECT_EQ(feedback.pair_capacity, 187u) << "a quarter more: what a view begins with was a guess";
  EXPECT_EQ(feedback.slot_capacity, 100u);
}

TEST(FinalListFeedback, grows_slots_for_pairs_that_found_no_room_as_well) {
  const FinalListNote note{.tiles = 10, .slot_capacity = 100, .pair_capacity = 200};
  const FinalListFeedback feedback = final_list_feedback(counters_of(800, 150), note, nullptr);
  EXPECT_EQ(feedback.pairs_asked, 800u);
  EXPECT_EQ(feedback.slots_asked, 600u) << "a fourth of the pairs took 150";
  EXPECT_GE(feedback.pair_capacity, 800u);
  EXPECT_GE(feedback.slot_capacity, 600u);
}

TEST(FinalListFeedback, of_a_frame_that_kept_visibilities_remembers_what_they_need_when_they_change) {
  const FinalListNote note{.tiles = 10, .slot_capacity = 1000, .pair_capacity = 1000};
  const FinalListFeedback moving = final_list_feedback(counters_of(800, 150), note, nullptr);
  shaders::ShadowListCounters counters = counters_of(3, 150);
  counters.kept = 797;
  const FinalListFeedback resting = final_list_feedback(counters, note, &moving);
  EXPECT_EQ(resting.pairs_asked, 800u);
  EXPECT_EQ(resting.pair_capacity, moving.pair_capacity);
  EXPECT_EQ(final_list_feedback(counters_of(3, 150), note, &resting).pairs_asked, 3u);
}

TEST(FinalListFeedback, of_no_room_at_all_is_a_number) {
  const FinalListNote note{.tiles = 10, .slot_capacity = 0, .pair_capacity = 0};
  const FinalListFeedback feedback = final_list_feedback(counters_of(5000, 0), note, nullptr);
  EXPECT_GE(feedback.pair_capacity, 5000u);
  EXPECT_GE(feedback.slot_capacity, 10 * kLeastSlotsPerTile);
  const FinalListFeedback most = final_list_feedback(counters_of(~0u, ~0u), note, &feedback);
  EXPECT_LE(most.slot_capacity, kMost);
  EXPECT_LE(most.slots_asked, kMost);
}

TEST(FinalListFeedback, asks_for_no_more_rows_of_pairs_than_every_device_can_dispatch) {
  constexpr std::uint64_t kMostRows = 65535;  // every Vulkan device has at least this maxComputeWorkGroupCount
  constexpr std::uint64_t kRow = GLOAM_PAIRS_ROW;
  const FinalListNote note{.tiles = 1000, .slot_capacity = 1000, .pair_capacity = 1u << 23};
  const auto capacity = [&](std::uint64_t pairs) {
    return final_list_feedback(counters_of(static_cast<std::uint32_t>(pairs), 0), note, nullptr).pair_capacity;
  };
  const std::uint64_t full = kMostRows * kRow * 4 / 5;  // with 25 % more they fill the last row
  EXPECT_EQ(capacity(full - 4), kMostRows * kRow - 5) << "below the limit there is room for all and a quarter more";
  EXPECT_EQ(capacity(full), kMostRows * kRow);
  for (const std::uint64_t pairs :
       {full + 1, full + kRow, kMostRows * kRow, (kMostRows + 1) * kRow, std::uint64_t{~0u}})
    EXPECT_EQ(capacity(pairs), kMostRows * kRow) << pairs;
  const FinalListNote largest{.tiles = 2048 * 2048, .slot_capacity = 0, .pair_capacity = (1u << 24)};
  const FinalListFeedback there{.pair_capacity = 1u << 24};
  const FinalListFeedback kept = final_list_feedback(counters_of(1u << 24, 0), largest, &there);
  EXPECT_LE((kept.pair_capacity + kRow - 1) / kRow, kMostRows) << "nor when more was there before";
}

/// Simulates frames whose counters are read back two frames later, until no buffer overflows.
TEST(FinalListFeedback, makes_room_for_any_need_in_a_few_frames_and_then_changes_nothing) {
  std::mt19937 random(11);
  for (int i = 0; i < 500; ++i) {
    const auto below = [&](std::uint32_t end) { return static_cast<std::uint32_t>(random() % end); };
    const std::uint32_t tiles = 1 + below(130000);
    const std::uint32_t pairs = below(1 + 16 * tiles) / (1 + below(16));
    const double share = std::uniform_real_distribution<double>(0.0, 1.0)(random);
    const std::uint32_t need = std::min(kMost, static_cast<std::uint32_t>(pairs * share));
    const std::uint32_t first = std::min(kMost, tiles * kLeastSlotsPerTile);
    std::optional<FinalListFeedback> known;
    std::vector<std::pair<shaders::ShadowListCounters, FinalListNote>> results;
    for (std::size_t frame = 0; frame < 14; ++frame) {
      if (frame >= 2) {
        const auto& [counters, then] = results[frame - 2];
        known = final_list_feedback(counters, then, known ? &*known : nullptr);
      }
      const FinalListNote note{.tiles = tiles,
                               .slot_capacity = known ? known->slot_capacity : first,
                               .pair_capacity = known ? known->pair_capacity : first};
      const auto asked = static_cast<std::uint32_t>(std::min(pairs, note.pair_capacity) * share);
      if (frame >= 6) {
        EXPECT_FALSE(pairs > note.pair_capacity || (asked > note.slot_capacity && need < kMost))
            << "frame " << frame << ", " << tiles << " tiles, " << pairs << " pairs, " << share;
        EXPECT_TRUE(frame == 6 || note.slot_capacity == results.back().second.slot_capacity);
        EXPECT_TRUE(frame == 6 || note.pair_capacity == results.back().second.pair_capacity);
      }
      results.emplace_back(counters_of(pairs, asked), note);
    }
    const std::uint32_t last_slots = results.back().second.slot_capacity;
    // The capacity is at most five times the need.
    EXPECT_LE(last_slots, std::max(tiles * kLeastSlotsPerTile, need * 5u)) << tiles << ' ' << pairs << ' ' << share;
  }
}

TEST(FinalListCapacities, hold_all_that_a_frame_can_need_until_a_need_is_known) {
  const FinalListCapacities few = final_list_capacities(nullptr, 100000, 3600, {}, view_at(0, 0));
  EXPECT_TRUE(few.complete);
  EXPECT_GE(few.slots, 100000u);
  EXPECT_LE(few.slots, 150000u);
  const FinalListCapacities many = final_list_capacities(nullptr, 900000, 14400, {}, view_at(0, 0));
  EXPECT_TRUE(many.complete) << "57 MB";
  const FinalListCapacities too_many = final_list_capacities(nullptr, 5000000, 14400, {}, view_at(0, 0));
  EXPECT_FALSE(too_many.complete);
  EXPECT_EQ(too_many.slots * std::uint64_t{64}, kMostBoundBytes);
}

TEST(FinalListCapacities, of_costly_bounds_follow_the_need) {
  const FinalListFeedback known{.pairs_asked = 30000,
                                .slots_asked = 20000,
                                .pair_capacity = 37500,
                                .slot_capacity = 28800,
                                .pair_bound = 600000,
                                .frame = 5};
  const FinalListCapacities c = final_list_capacities(&known, 600000, 14400, {}, view_at(7, 0));
  EXPECT_FALSE(c.complete);
  EXPECT_EQ(c.slots * std::uint64_t{64}, kCheapSlotBytes) << "the bound asks for 38 MB";
  EXPECT_GE(c.pairs, 600000u) << "pairs are small";
  const FinalListCapacities cut = final_list_capacities(&known, 600000, 14400, {}, view_at(7, 6));
  EXPECT_TRUE(cut.complete) << "what was known before a camera cut tells nothing";
}

TEST(FinalListCapacities, stay_below_the_limits_of_the_knobs) {
  ShadowKnobs knobs;
  knobs.slot_limit = 10;
  const FinalListCapacities slots = final_list_capacities(nullptr, 1000, 100, knobs, view_at(0, 0));
  EXPECT_EQ(slots.slots, 10u);
  EXPECT_FALSE(slots.complete);
  knobs.slot_limit = 2000;
  knobs.pair_limit = 20;
  const FinalListCapacities pairs = final_list_capacities(nullptr, 1000, 100, knobs, view_at(0, 0));
  EXPECT_EQ(pairs.pairs, 20u);
  EXPECT_FALSE(pairs.complete);
}

struct Counted final : CounterSink {
  void count(std::string_view name, double value) override { values[std::string(name)] = value; }
  std::map<std::string, double> values;
};

TEST(CountFinalLists, tells_each_number_and_the_share_that_no_pixel_was_asked_about) {
  shaders::ShadowListCounters c{};
  c.tiles = 9;
  c.candidates = 40;
  c.unshadowed = 5;
  c.lit_at_once = 12;
  c.unlit_at_once = 13;
  c.pairs = 10;
  c.lit_by_filter = 2;
  c.unlit_by_filter = 3;
  c.slots = 5;
  c.fallback_tiles = 1;
  Counted sink;
  count_final_lists(c,
                    {.tiles = 12,
                     .slot_capacity = 24,
                     .pair_capacity = 25,
                     .list_bytes = 1000,
                     .visibility_bytes = 2000,
                     .visibility_bits = 4},
                    sink);
  const std::map<std::string, double> expected = {{"shadows.tile_lights", 40},
                                                  {"shadows.tile_lights_unshadowed", 5},
                                                  {"shadows.tile_lights_lit", 12},
                                                  {"shadows.tile_lights_unlit", 13},
                                                  {"shadows.tile_lights_filtered", 10},
                                                  {"shadows.tile_lights_filtered_lit", 2},
                                                  {"shadows.tile_lights_filtered_unlit", 3},
                                                  {"shadows.classified_share", 0.75},
                                                  {"shadows.slots", 5},
                                                  {"shadows.slot_capacity", 24},
                                                  {"shadows.pair_capacity", 25},
                                                  {"shadows.fallback_tiles", 1},
                                                  {"shadows.list_bytes", 1000},
                                                  {"shadows.visibility_bytes", 2000},
                                                  {"shadows.fixed_visibility_bytes", 12 * 32 * 32}};
  for (const auto& [name, value] : expected) EXPECT_EQ(sink.values[name], value) << name;
}

TEST(CountFinalLists, of_nothing_divides_by_nothing) {
  Counted sink;
  count_final_lists({}, {}, sink);
  for (const auto& [name, value] : sink.values) EXPECT_TRUE(std::isfinite(value)) << name;
}

}  // namespace
}  // namespace gloam
