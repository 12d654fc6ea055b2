// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <set>

#include "tests/modules/closeups/scene.h"

// Close-ups with buffers that are too small, in frames that do not need them, and in random scenes.

namespace gloam::test {
namespace {

class CloseupLimits : public CloseupScene {
 protected:
  void put_scene() {
    put_room();
    put(shapes_[0], glm::scale(glm::rotate(at(-0.9, 0.25, -0.7), 0.5, dvec3(0.0, 1.0, 0.0)), dvec3(0.4, 0.5, 0.4)));
    put_far_boxes();
    first = put_figure(dvec3(0.3, 0.0, 0.4));
    second = put_figure(dvec3(-0.4, 0.0, 0.0), 0.8, 1.3);
  }
  void put_lights_of_all_kinds() {
    put_light(point(0.08f), dvec3(0.9, 1.7, 0.9), dvec3(0.0, -1.0, 0.0), 256);
    put_light(spot(45.0, 0.06f), dvec3(-0.7, 2.0, 1.2), dvec3(0.3, -1.0, -0.5), 512);
    Light day = sun(0.02f);
    day.intensity = 2.0f;
    put_light(day, dvec3(0.0), dvec3(0.5, -1.0, -0.4), 512);
    set("shadows.atlas", "2048");
  }
  /// freed: the memory of kept maps has been freed.
  void expect_no_closeups(const std::string& what, bool freed = true) {
    EXPECT_FALSE(has_closeup_pass()) << what;
    EXPECT_EQ(counted("closeups.pairs"), 0.0) << what;
    EXPECT_EQ(counted("closeups.tiles"), 0.0) << what;
    renderer->free_idle_memory();
    if (freed) {
      EXPECT_EQ(module_state("closeups").gpu_bytes, 0u) << what;
    }
  }

  Figure first, second;
};

/// Parameter: bits per visibility.
class CloseupSlots : public CloseupLimits, public ::testing::WithParamInterface<const char*> {};

// Hard case: shadows.full_visibility_closeups
TEST_P(CloseupSlots, are_made_up_for_by_standard_maps_where_there_are_none) {
  set("shadows.visibility_bits", GetParam());
  put_scene();
  put_lights_of_all_kinds();
  const CloseupShot all = second_shot();
  ASSERT_EQ(counted("closeups.pairs"), 6.0);
  ASSERT_EQ(counter("shadows.fallback_tiles"), 0.0);
  const double need = counter("shadows.slots");
  EXPECT_EQ(need, static_cast<double>(all.lists.counters.slots)) << "those that close-ups take are counted";
  ASSERT_GT(need, 20.0);
  expect_slots_are_one_entrys(all.lists, "unlimited");
  for (const double share : {0.0, 0.5, 0.99}) {
    const std::string what = std::string(GetParam()) + " bits, share " + std::to_string(share);
    set("shadows.slot_limit", std::to_string(static_cast<int>(need * share)));
    const CloseupShot limited = second_shot();
    EXPECT_GT(counter("shadows.fallback_tiles"), 0.0) << what;
    expect_fallback_listed_once(limited.lists, what);
    expect_slots_are_one_entrys(limited.lists, what);
    expect_finite_maps(what);
    const double off = differing(limited.light, all.light);
    std::printf("%s: %zu tiles fall back, %.4f of the pixels differ\n", what.c_str(),
                limited.lists.fallback_tiles.size(), off);
    // The two kinds of maps differ by part of a pixel at silhouettes. Without the subjects the share would be 0.04.
    EXPECT_LE(off, 0.01) << what;
  }
  set("shadows.slot_limit", std::to_string(static_cast<int>(need)));
  const CloseupShot enough = second_shot();
  EXPECT_EQ(counter("shadows.fallback_tiles"), 0.0);
  EXPECT_EQ(enough.light.rgba, all.light.rgba) << "just enough";
}

INSTANTIATE_TEST_SUITE_P(Bits, CloseupSlots, ::testing::Values("8", "4"));

// Tiles also fall back when tile-light pairs, not slots, run out. Compose must leave these tiles alone.
// Hard case: shadows.full_slots_closeups
TEST_F(CloseupLimits, tiles_without_a_list_show_subjects_from_standard_maps) {
  put_scene();
  put_lights_of_all_kinds();
  const CloseupShot all = second_shot();
  set("shadows.pair_limit", "1");
  const CloseupShot limited = second_shot();
  EXPECT_GT(counter("shadows.fallback_tiles"), 0.0);
  expect_fallback_listed_once(limited.lists, "one pair");
  EXPECT_LE(differing(limited.light, all.light), 0.01);
}

/// Whether the frame copied standard faces, or transferred subjects into them.
bool made_an_overlay(const FrameReport& report) {
  return std::ranges::any_of(report.passes, [](const PassTime& pass) {
    return pass.name == "closeup_transfer" || pass.name.starts_with("shadow_overlay");
  });
}

// The tiles of the umbra ranges always have their slots. Slots are limited so that lists of other
// tiles do not fit: these fall back, and nobody needs the subject in standard maps.
// Hard case: shadows.full_visibility_closeups
TEST_F(CloseupLimits, slots_of_umbra_tiles_are_reserved) {
  settings.width = 320, settings.height = 200;
  put_room();
  put(shapes_[0], glm::scale(glm::rotate(at(-0.9, 0.25, -0.7), 0.5, dvec3(0.0, 1.0, 0.0)), dvec3(0.4, 0.5, 0.4)));
  put_far_boxes();
  first = put_figure(dvec3(1.0, 0.0, 0.6), 0.6);
  put_light(point(0.08f), dvec3(1.4, 1.9, 0.9), dvec3(0.0, -1.0, 0.0), 256);
  put_light(spot(45.0, 0.06f), dvec3(-0.7, 2.0, 1.2), dvec3(0.3, -1.0, -0.5), 512);
  put_light(spot(55.0, 0.1f), dvec3(0.4, 1.4, 0.2), dvec3(-0.3, -1.0, -0.5), 512);
  set("shadows.atlas", "2048");
  const CloseupShot all = second_shot();
  ASSERT_GT(counted("closeups.pairs"), 0.0);
  ASSERT_EQ(counter("shadows.fallback_tiles"), 0.0);
  EXPECT_EQ(counter("shadows.slots_reserved"), 0.0) << "all lists fit anyway";
  EXPECT_FALSE(made_an_overlay(renderer->report()));
  const double need = counter("shadows.slots");
  const TileRange umbra = all.views.pairs.front().tiles;
  // The least number of slots that holds the reservation.
  int too_few = static_cast<int>(need), least = 4000;
  while (least - too_few > 1) {
    const int middle = (too_few + least) / 2;
    set("shadows.slot_limit", std::to_string(middle));
    draw();
    (made_an_overlay(renderer->report()) ? too_few : least) = middle;
  }
  std::size_t fell_back = 0;
  for (const int more : {-1, 0, 5, 1000}) {
    const std::string what = std::to_string(least + more) + " slots";
    set("shadows.slot_limit", std::to_string(least + more));
    const CloseupShot limited = second_shot();
    expect_fallback_listed_once(limited.lists, what);
    EXPECT_EQ(counted("closeups.pairs"), static_cast<double>(all.views.pairs.size())) << what;
    EXPECT_EQ(made_an_overlay(renderer->report()), more < 0) << what;
    if (more < 0) continue;
    EXPECT_EQ(counter("shadows.slots"), need) << what << ": all that is needed is counted";
    EXPECT_GT(counter("shadows.slots_reserved"), 0.0) << what;
    EXPECT_EQ(counter("shadows.fallback_tiles"), static_cast<double>(limited.lists.fallback_tiles.size())) << what;
    fell_back += limited.lists.fallback_tiles.size();
    std::set<std::uint32_t> taken;
    for (std::uint32_t tile = 0; tile < limited.lists.texels.size(); ++tile) {
      const uvec2 at(tile % limited.lists.tiles.x, tile / limited.lists.tiles.x);
      const bool inside = at.x >= umbra.begin.x && at.y >= umbra.begin.y && at.x < umbra.end.x && at.y < umbra.end.y;
      EXPECT_TRUE(!inside || limited.lists.complete(tile)) << what << ", tile " << tile;
      for (const bool directional : {false, true})
        for (const std::uint32_t entry : limited.lists.run(tile, directional))
          EXPECT_TRUE(entry >> 10 >= GLOAM_NO_ROOM || taken.insert(entry >> 10).second) << what << ", tile " << tile;
    }
    // Fallback tiles evaluate the same filter, so the picture is the same.
    expect_same({limited.light, limited.picture}, {all.light, all.picture}, what);
    std::printf("%s: %zu tiles fall back\n", what.c_str(), limited.lists.fallback_tiles.size());
  }
  EXPECT_GT(fell_back, 0u) << "tiles beside the umbra fall back";
}

TEST_F(CloseupLimits, buffers_grow_to_hold_what_closeups_take) {
  put_scene();
  put_lights_of_all_kinds();
  for (int i = 0; i < 4; ++i) draw();
  EXPECT_EQ(counted("closeups.pairs"), 6.0);
  EXPECT_EQ(counter("shadows.fallback_tiles"), 0.0);
}

TEST_F(CloseupLimits, nothing_is_done_without_final_lists) {
  put_scene();
  put_lights_of_all_kinds();
  draw();
  draw();
  EXPECT_TRUE(has_closeup_pass());
  EXPECT_GT(module_state("closeups").gpu_bytes, 0u);
  for (const char* mode : {"monolithic", "off"}) {
    set("shadows.mode", mode);
    draw();
    draw();
    expect_no_closeups(mode, false);
    const LinearPicture with = linear(settings.id.value);
    set("closeups.max_pairs", "0");
    draw();
    draw();
    EXPECT_EQ(with.rgba, linear(settings.id.value).rgba) << mode;
    set("closeups.max_pairs", "8");
  }
  set("shadows.mode", "deferred");
  set("closeups.max_pairs", "0");
  for (std::uint32_t i = 0; i <= kFramesUntilRelease; ++i) draw();
  expect_no_closeups("no room for pairs");
  set("closeups.max_pairs", "8");
  draw();
  EXPECT_TRUE(has_closeup_pass());
}

TEST_F(CloseupLimits, nothing_is_done_without_subjects_in_view) {
  put_scene();
  put_lights_of_all_kinds();
  for (const Figure* figure : {&first, &second}) world.get<CloseupSubject>(figure->root).enabled = false;
  const CloseupShot disabled = second_shot();
  expect_no_closeups("disabled");
  EXPECT_FALSE(module_state("closeups").demanded);
  for (const Figure* figure : {&first, &second}) world.remove<CloseupSubject>(figure->root);
  const CloseupShot removed = second_shot();
  expect_no_closeups("removed");
  EXPECT_FALSE(module_state("closeups").demanded);
  EXPECT_EQ(disabled.light.rgba, removed.light.rgba);
}

// Values that make no sense in a scene: nothing may become NaN, and nothing may crash.
// Hard case: shadows.all_finite
TEST_F(CloseupLimits, values_out_of_reason_leave_everything_finite) {
  put_scene();
  put_lights_of_all_kinds();
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const dmat4 there = world.get<LocalMatrix>(first.parts[0]).matrix;
  for (const double value : {nan, inf, 0.0, 1e9, 1e30}) {
    dmat4 broken = there;
    broken[3].x = value;
    place_part(first, 0, broken);
    static_cast<void>(second_shot());
    broken = there;
    broken[1] *= value;
    place_part(first, 0, broken);
    static_cast<void>(second_shot());
    place_part(first, 0, there);
  }
  for (const float value :
       {0.0f, 1e-6f, 1e6f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(), -1.0f}) {
    for (const Entity lamp : lamps) {
      auto& light = world.get<Light>(lamp);
      const Light before = light;
      light.width_m = value;
      light.apparent_angle = value;
      world.mark_changed<Light>(lamp);
      static_cast<void>(shot());
      light = before;
      light.range_m = value;
      light.intensity = 1e6f;
      world.mark_changed<Light>(lamp);
      static_cast<void>(shot());
      light = before;
      world.mark_changed<Light>(lamp);
    }
  }
  expect_finite_maps("values out of reason");
  const CloseupShot again = second_shot();
  EXPECT_EQ(counted("closeups.pairs"), 6.0);
  renderer->release_world(world);
  EXPECT_EQ(second_shot().light.rgba, again.light.rgba);
}

}  // namespace
}  // namespace gloam::test
