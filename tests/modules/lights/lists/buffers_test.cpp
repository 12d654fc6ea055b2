// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/lists/buffers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>
#include <set>
#include <vector>

namespace gloam {
namespace {

constexpr std::uint32_t kMostEntries = static_cast<std::uint32_t>(kMostListBytes / 4 * 3);

struct Counted final : CounterSink {
  void count(std::string_view name, double value) override { values[std::string(name)] = value; }
  std::map<std::string, double> values;
};

RenderView view_of(bool orthographic) {
  ViewSettings settings;
  settings.width = 64;
  settings.height = 48;
  settings.camera.orthographic = orthographic;
  settings.camera.half_height_m = 3.0f;
  settings.camera.near_m = 0.25f;
  return make_view(settings, 0);
}

TEST(ListCapacity, begins_with_three_entries_a_tile) {
  EXPECT_EQ(list_capacity(40, 0, {}), 120u);
  EXPECT_EQ(list_capacity(1, 0, {}), 3u);
}

TEST(ListCapacity, follows_what_was_asked_for_with_a_quarter_more) {
  EXPECT_EQ(list_capacity(40, 0, {.entries_asked = 1000, .slot_capacity = 360}), 1251u) << "1250 in words of three";
  EXPECT_EQ(list_capacity(40, 0, {.entries_asked = 1300, .slot_capacity = 1251}), 1626u);
}

TEST(ListCapacity, stays_while_it_is_enough_and_not_far_too_much) {
  EXPECT_EQ(list_capacity(40, 0, {.entries_asked = 1251, .slot_capacity = 1251}), 1251u);
  EXPECT_EQ(list_capacity(40, 0, {.entries_asked = 400, .slot_capacity = 1251}), 1251u);
  EXPECT_EQ(list_capacity(40, 0, {.entries_asked = 400, .slot_capacity = 12000}), 501u);
  EXPECT_EQ(list_capacity(40, 0, {.entries_asked = 0, .slot_capacity = 12000}), 120u);
}

TEST(ListCapacity, of_a_picture_that_has_grown_has_room_for_its_tiles) {
  EXPECT_EQ(list_capacity(400, 0, {.entries_asked = 300, .slot_capacity = 360}), 1200u);
}

TEST(ListCapacity, never_needs_more_than_128_mib) {
  EXPECT_EQ(list_capacity(129600, 0, {.entries_asked = 129600 * 1024u, .slot_capacity = 999}), kMostEntries);
  EXPECT_EQ(list_capacity(129600, 0, {.entries_asked = ~0u, .slot_capacity = kMostEntries}), kMostEntries);
  EXPECT_EQ(list_capacity(129600, fixed_slots_of(1024), {}), kMostEntries);
}

TEST(ListCapacity, fits_all_of_few_lights_and_changes_in_few_steps) {
  std::set<std::uint32_t> steps;
  for (std::uint32_t lights = 1; lights <= 48; ++lights) {
    EXPECT_GE(entries_that_fit_all(lights, 3600), lights);
    EXPECT_EQ(entries_that_fit_all(lights, 3600) % 3, 0u);
    steps.insert(entries_that_fit_all(lights, 3600));
  }
  EXPECT_LE(steps.size(), 2u);
  EXPECT_EQ(entries_that_fit_all(49, 3600), 0u);
  EXPECT_EQ(entries_that_fit_all(1, 1u << 20), 0u) << "for so many tiles that would be megabytes";
}

TEST(ListCapacity, of_fixed_slots_is_so_many_a_tile) {
  EXPECT_EQ(fixed_slots_of(0), 0u);
  EXPECT_EQ(fixed_slots_of(1), 3u);
  EXPECT_EQ(fixed_slots_of(30), 30u);
  EXPECT_EQ(fixed_slots_of(1024), 1026u);
  EXPECT_EQ(list_capacity(40, 30, {.entries_asked = 9999, .slot_capacity = 9999}), 1200u);
}

TEST(LightFeedbackOf, counters_knows_how_far_the_farthest_surface_is) {
  for (const bool orthographic : {false, true}) {
    const LightCountersNote note{view_of(orthographic), 432, false};
    for (const float metres : {0.3f, 4.0f, 70.0f}) {
      const vec4 clip = note.view.clip_from_view * vec4(0.0f, 0.0f, -metres, 1.0f);
      shaders::LightCounters counters{};
      counters.slots = 123;
      counters.farthest_depth = std::bit_cast<std::uint32_t>(clip.z / clip.w);
      const LightFeedback feedback = light_feedback(counters, note, nullptr);
      EXPECT_NEAR(feedback.farthest_m, metres, 1e-3f * metres) << orthographic;
      EXPECT_EQ(feedback.entries_asked, 123u);
      EXPECT_EQ(feedback.slot_capacity, 432u);
    }
  }
}

TEST(LightFeedbackOf, a_picture_of_sky_knows_no_distance) {
  shaders::LightCounters counters{};
  counters.farthest_depth = std::bit_cast<std::uint32_t>(1.0f);
  EXPECT_EQ(light_feedback(counters, {view_of(false), 360, false}, nullptr).farthest_m, 0.0f);
  counters.farthest_depth = 0;  // no surface has this depth: infinitely far
  EXPECT_EQ(light_feedback(counters, {view_of(false), 360, false}, nullptr).farthest_m, 0.0f);
}

/// Feedback comes from two frames before. If the capacity continued from that frame's, odd and even frames would have
/// different capacities.
TEST(LightFeedbackOf, frames_in_flight_settles_at_one_capacity) {
  const RenderView view = view_of(false);
  constexpr std::uint32_t kTiles = 8 * 6;
  const auto asked_by = [](std::size_t frame) {
    return 3 * static_cast<std::uint32_t>(std::min<std::size_t>(frame, 20)) * 37;
  };
  LightFeedback feedback;
  std::vector<std::uint32_t> capacities;
  for (std::size_t frame = 0; frame < 60; ++frame) {
    if (frame >= gpu::Device::kFramesInFlight) {
      const std::size_t counted = frame - gpu::Device::kFramesInFlight;
      shaders::LightCounters counters{};
      counters.slots = asked_by(counted);
      feedback = light_feedback(counters, {view, capacities[counted], false}, counted == 0 ? nullptr : &feedback);
    }
    capacities.push_back(list_capacity(kTiles, 0, feedback));
  }
  EXPECT_GE(capacities.back(), asked_by(59));
  for (std::size_t frame = 30; frame < 60; ++frame) EXPECT_EQ(capacities[frame], capacities[29]) << "frame " << frame;
}

TEST(LightCounterValues, are_means_over_tiles_and_sums) {
  shaders::LightCounters counters{};
  counters.slots = 27;
  counters.overflow_tiles = 2;
  counters.violations = 1;
  counters.tiles = 4;
  counters.mask_lights = 40;
  counters.candidate_lights = 20;
  counters.approx_lights = 10;
  counters.group_lights = 16;
  counters.accurate_lights = 6;
  counters.culling_errors = 5;
  Counted counted;
  count_lights(counters, {RenderView{}, 360, false}, counted);
  const std::map<std::string, double> expected = {
      {"lights.per_tile_mask_mean", 10.0},    {"lights.per_tile_candidates_mean", 5.0},
      {"lights.per_tile_approx_mean", 2.5},   {"lights.per_tile_group_mean", 4.0},
      {"lights.per_tile_accurate_mean", 1.5}, {"lights.list_entries", 27.0},
      {"lights.list_capacity", 360.0},        {"lights.overflow_tiles", 2.0},
      {"lights.capacity_violations", 1.0}};
  EXPECT_EQ(counted.values, expected) << "culling errors are only told when they were looked for";
  count_lights(counters, {RenderView{}, 360, true}, counted);
  EXPECT_EQ(counted.values["lights.culling_errors"], 5.0);
}

TEST(LightCounterValues, of_a_picture_of_sky_are_zero) {
  Counted counted;
  count_lights({}, {}, counted);
  for (const auto& [name, value] : counted.values) EXPECT_EQ(value, 0.0) << name;
}

}  // namespace
}  // namespace gloam
