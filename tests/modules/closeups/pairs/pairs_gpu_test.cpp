// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>

#include "modules/closeups/pairs/bounds.h"
#include "tests/modules/closeups/scene.h"

// Several pairs: composed one after another into the same tiles, in any order, with and without their own maps, added
// and removed.

namespace gloam::test {
namespace {

class CloseupPairs : public CloseupScene {
 protected:
  /// A light above the floor, and a camera that sees the floor below the subjects.
  Entity put_stage(LightKind kind, float width = 0.0f) {
    put(plane_, flat(0.0) * glm::scale(dmat4(1.0), dvec3(3.0)));
    put_far_boxes();
    settings = look_at(dvec3(0.0, 0.7, 2.2), dvec3(0.0, 0.0, 0.0), 160, 96);
    if (kind == LightKind::directional) return put_light(sun(width), dvec3(0.0), dvec3(0.02, -1.0, 0.01), 1024);
    const Light made = kind == LightKind::spot ? spot(40.0, width) : point(width);
    return put_light(made, dvec3(0.0, 4.0, 0.1), dvec3(0.0, -1.0, 0.0), 1024);
  }
  /// Two blocks at different heights that overlap above the middle.
  void put_halves() {
    left = put_block(dvec3(-0.43, 1.5, 0.0), dvec3(1.0, 0.05, 0.9));
    right = put_block(dvec3(0.481, 1.6, 0.0), dvec3(0.95, 0.05, 0.9));
  }
  void set_priorities(float of_left, float of_right) {
    world.get<CloseupSubject>(left.root).priority = of_left;
    world.get<CloseupSubject>(right.root).priority = of_right;
  }
  void set_subjects(bool of_left, bool of_right) {
    for (const auto& [figure, is_subject, shows] :
         {std::tuple{&left, of_left, of_left}, std::tuple{&right, of_right, of_right}}) {
      world.get<CloseupSubject>(figure->root).enabled = is_subject;
      if (!shows) hide(*figure);
      if (shows && !world.has<MeshInstance>(figure->parts[0])) show(*figure);
    }
  }
  void expect_same_shots(const CloseupShot& a, const CloseupShot& b, const std::string& what) const {
    for (const Entity lamp : lamps)
      EXPECT_EQ(seen(a.lists, lamp).pixels, seen(b.lists, lamp).pixels) << what << ": " << names_.at(lamp);
    EXPECT_EQ(a.light.rgba, b.light.rgba) << what;
    EXPECT_EQ(a.picture.rgba, b.picture.rgba) << what;
  }
  /// Tiles that both subjects together take from lit to unlit, through slots.
  void expect_lit_partly_unlit(LightKind kind) {
    set("shadows.reuse", "off");  // lists of which entries are kept hold none that a pair has made unlit
    const Entity lamp = put_stage(kind);
    put_halves();
    std::vector<std::vector<std::uint32_t>> slots;
    std::vector<double> taken;
    for (const auto& [with_left, with_right] :
         {std::pair(false, false), std::pair(true, false), std::pair(false, true), std::pair(true, true)}) {
      set_subjects(with_left, with_right);
      const CloseupShot taken_shot = second_shot();
      EXPECT_EQ(counted("closeups.pairs"), (with_left ? 1.0 : 0.0) + (with_right ? 1.0 : 0.0));
      slots.push_back(seen(taken_shot.lists, lamp).slots);
      taken.push_back(counter("shadows.slots"));
    }
    std::size_t through_left = 0, through_right = 0, both = 0;
    for (std::size_t tile = 0; tile < slots[0].size(); ++tile) {
      const std::uint32_t none = slots[0][tile], by_left = slots[1][tile], by_right = slots[2][tile],
                          by_both = slots[3][tile];
      if (none == GLOAM_NO_ROOM) continue;
      ASSERT_EQ(none, GLOAM_ALL_LIT) << tile;
      // A tile that one subject makes unlit stays unlit; a tile that neither changes stays lit.
      if (by_left == GLOAM_ALL_UNLIT || by_right == GLOAM_ALL_UNLIT) {
        EXPECT_EQ(by_both, GLOAM_ALL_UNLIT) << tile;
      }
      if (by_left == GLOAM_ALL_LIT && by_right == GLOAM_ALL_LIT) {
        EXPECT_EQ(by_both, GLOAM_ALL_LIT) << tile;
      }
      const bool left_slot = by_left < GLOAM_NO_ROOM, right_slot = by_right < GLOAM_NO_ROOM;
      through_left += left_slot && by_both == GLOAM_ALL_UNLIT ? 1 : 0;
      through_right += right_slot && by_both == GLOAM_ALL_UNLIT ? 1 : 0;
      both += left_slot && right_slot && by_both == GLOAM_ALL_UNLIT ? 1 : 0;
    }
    EXPECT_GT(through_left, 0u);
    EXPECT_GT(through_right, 0u);
    EXPECT_GT(both, 0u) << "lit, partly, unlit";
    EXPECT_EQ(taken[0], 0.0);
    EXPECT_LE(taken[3], taken[1] + taken[2]) << "no tile takes two";
  }

  Figure left, right;
};

// Hard case: shadows.closeup_two_in_tile, shadows.closeup_successive
TEST_F(CloseupPairs, take_a_lamp_from_tiles_one_after_the_other) { expect_lit_partly_unlit(LightKind::point); }
// Hard case: shadows.closeup_successive
TEST_F(CloseupPairs, take_a_spot_from_tiles_one_after_the_other) { expect_lit_partly_unlit(LightKind::spot); }
// Hard case: shadows.closeup_successive
TEST_F(CloseupPairs, take_a_sun_from_tiles_one_after_the_other) { expect_lit_partly_unlit(LightKind::directional); }

// Hard case: shadows.closeup_successive
TEST_F(CloseupPairs, finish_what_the_standard_map_left) {
  const Entity lamp = put_stage(LightKind::spot);
  put_halves();
  world.get<CloseupSubject>(right.root).enabled = false;
  const CloseupShot one = second_shot();
  EXPECT_EQ(counted("closeups.pairs"), 1.0);
  world.get<CloseupSubject>(right.root).enabled = true;
  const CloseupShot two = second_shot();
  EXPECT_EQ(counted("closeups.pairs"), 2.0);
  const SeenLight with_one = seen(one.lists, lamp), with_two = seen(two.lists, lamp);
  SeenDifference off;
  for (std::size_t i = 0; i < with_one.pixels.size(); ++i)
    if (gives(one.geometry, i, lamp)) off.add(with_one.pixels[i], with_two.pixels[i]);
  // The standard map and the close-up map differ by one pixel at silhouettes.
  EXPECT_LE(off.mean(), 0.01);
  EXPECT_LE(off.half_share(), 0.005);
  EXPECT_GT(std::ranges::count(with_one.slots, GLOAM_ALL_UNLIT), 0);
}

// Hard case: shadows.closeup_two_in_tile
TEST_F(CloseupPairs, in_another_order_give_the_same_picture) {
  put_stage(LightKind::point, 0.1f);
  put_light(spot(40.0, 0.05f), dvec3(-0.5, 3.0, 1.0), dvec3(0.2, -1.0, -0.3), 512);
  Light day = sun(0.02f);
  day.intensity = 2.0f;
  put_light(day, dvec3(0.0), dvec3(0.3, -1.0, 0.2), 512);
  put_halves();
  for (const char* bits : {"8", "4"}) {
    set("shadows.visibility_bits", bits);
    set_priorities(2.0f, 1.0f);
    const CloseupShot one = second_shot();
    EXPECT_EQ(counted("closeups.pairs"), 6.0);
    EXPECT_EQ(one.views.pairs.front().subject, left.root);
    set_priorities(1.0f, 2.0f);
    const CloseupShot other = second_shot();
    EXPECT_EQ(other.views.pairs.front().subject, right.root);
    expect_same_shots(one, other, std::string(bits) + " bits");
  }
}

TEST_F(CloseupPairs, that_share_the_map_give_the_same_picture) {
  put_stage(LightKind::point, 0.06f);
  put_light(spot(45.0, 0.05f), dvec3(0.2, 3.5, 0.6), dvec3(0.0, -1.0, -0.1), 512);
  // Of equal size in view, so that their maps have the same size.
  left = put_block(dvec3(-0.45, 1.0, 0.0), dvec3(0.7, 0.1, 0.7));
  right = put_block(dvec3(0.45, 1.0, 0.0), dvec3(0.7, 0.1, 0.7));
  std::uint32_t largest = 0;
  for (const char* density : {"1", "8"}) {
    set("closeups.texels_per_pixel", density);
    CloseupShot first;
    for (const char* batch : {"4", "2", "1"}) {
      set("closeups.batch", batch);
      const CloseupShot taken = second_shot();
      ASSERT_EQ(taken.views.pairs.size(), 4u);
      for (const CloseupView& pair : taken.views.pairs)
        ASSERT_EQ(pair.face.square.size, taken.views.pairs[0].face.square.size);
      largest = taken.views.pairs[0].face.square.size;
      if (first.picture.rgba.empty()) first = taken;
      EXPECT_LE(steps_apart(taken.picture, first.picture), 1.0) << density << ' ' << batch;
    }
  }
  EXPECT_EQ(largest, 1024u) << "a quarter of the map: four of these are more than one batch of standard maps";
}

TEST_F(CloseupPairs, that_share_a_map_with_larger_ones_are_as_good) {
  const Entity lamp = put_stage(LightKind::point, 0.06f);
  left = put_block(dvec3(-0.45, 1.0, 0.0), dvec3(0.8, 0.1, 0.8));
  right = put_block(dvec3(0.5, 0.03, 0.2), dvec3(0.04, 0.06, 0.04));
  set("closeups.batch", "1");
  const CloseupShot alone = second_shot();
  ASSERT_EQ(alone.views.pairs.size(), 2u);
  EXPECT_NE(alone.views.pairs[0].face.square.size, alone.views.pairs[1].face.square.size);
  set("closeups.batch", "2");
  const CloseupShot shared = second_shot();
  const SeenLight a = seen(alone.lists, lamp), b = seen(shared.lists, lamp);
  SeenDifference off;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    if (gives(alone.geometry, i, lamp)) off.add(a.pixels[i], b.pixels[i]);
  // The smaller one's silhouettes move by at most half a pixel.
  EXPECT_LE(off.mean(), 0.005);
  EXPECT_LE(off.half_share(), 0.002);
}

TEST_F(CloseupPairs, beyond_the_budget_are_in_standard_maps) {
  const Entity lamp = put_stage(LightKind::spot, 0.05f);
  const Entity second = put_light(point(0.05f), dvec3(0.6, 3.0, 0.8), dvec3(0.0, -1.0, 0.0), 1024);
  set("shadows.atlas", "4096");
  put_halves();
  CloseupShot all;
  for (const int most : {8, 3, 2, 1, 0}) {
    set("closeups.max_pairs", std::to_string(most));
    const CloseupShot taken = second_shot();
    const auto drawn = static_cast<double>(std::min(most, 4));
    EXPECT_EQ(counted("closeups.pairs"), drawn);
    EXPECT_EQ(counted("closeups.skipped"), most > 0 ? 4.0 - drawn : 0.0);
    if (all.picture.rgba.empty()) all = taken;
    for (const Entity light : {lamp, second}) {
      const SeenLight a = seen(all.lists, light), b = seen(taken.lists, light);
      SeenDifference off;
      for (std::size_t i = 0; i < a.pixels.size(); ++i)
        if (gives(all.geometry, i, light)) off.add(a.pixels[i], b.pixels[i]);
      // Silhouettes may differ by a pixel. So may overlapping penumbrae of both blocks, which close-up maps filter one
      // by one.
      EXPECT_LE(off.mean(), 0.015) << most << ' ' << names_.at(light);
      EXPECT_LE(off.half_share(), 0.01) << most << ' ' << names_.at(light);
    }
  }
}

TEST_F(CloseupPairs, that_come_and_go_are_right_in_that_very_frame) {
  put_stage(LightKind::spot, 0.05f);
  Light day = sun(0.02f);
  day.intensity = 2.0f;
  put_light(day, dvec3(0.0), dvec3(0.4, -1.0, -0.2), 256);
  put_halves();
  const auto stand = [&](double x) {
    place_part(left, 0, glm::scale(at(x, 0.5, 0.3), dvec3(0.5, 0.4, 0.3)));
    place_part(right, 0, glm::scale(at(-0.6 - 0.3 * x, 0.4, 0.2), dvec3(0.3, 0.4, 0.3)));
  };
  const std::vector<double> path = {0.0, 1.0, 2.9, 30.0, 2.2, 0.3, -40.0, -2.4, 0.1};
  std::vector<CloseupShot> walked;
  std::vector<double> pairs;
  stand(path[0]);
  draw();
  for (const double x : path) {
    stand(x);
    walked.push_back(shot());
    pairs.push_back(counted("closeups.pairs"));
  }
  EXPECT_NE(*std::ranges::min_element(pairs), *std::ranges::max_element(pairs)) << "pairs come and go";
  for (std::size_t i = 0; i < path.size(); ++i) {
    stand(path[i]);
    renderer->release_world(world);
    const CloseupShot fresh = shot();
    EXPECT_EQ(counted("closeups.pairs"), pairs[i]) << i;
    expect_same_shots(walked[i], fresh, "frame " + std::to_string(i));
  }
}

TEST_F(CloseupPairs, that_are_switched_are_right_in_that_very_frame) {
  put_stage(LightKind::point, 0.05f);
  put_halves();
  draw();
  draw();
  const auto expect_as_fresh = [&](const std::string& what) {
    const CloseupShot now = shot();
    renderer->release_world(world);
    expect_same_shots(now, shot(), what);
    draw();
  };
  expect_as_fresh("both");
  world.get<CloseupSubject>(left.root).enabled = false;
  expect_as_fresh("one");
  set("closeups.max_pairs", "0");
  expect_as_fresh("none");
  set("closeups.max_pairs", "1");
  world.get<CloseupSubject>(left.root).enabled = true;
  expect_as_fresh("room for one");
  world.get<Light>(lamps[0]).intensity = 0.0f;
  world.mark_changed<Light>(lamps[0]);
  expect_as_fresh("no light");
  world.get<Light>(lamps[0]).intensity = 20.0f;
  world.mark_changed<Light>(lamps[0]);
  expect_as_fresh("light");
}

TEST_F(CloseupPairs, leave_nothing_in_a_world_that_does_not_demand_them) {
  put_stage(LightKind::point, 0.05f);
  put_halves();
  const auto left_behind = [&] {
    const CloseupViews& views = world.view_resource<CloseupViews>(ViewId{0});
    return world.view<const CloseupPair>().size() + views.pairs.size() + views.in_view + views.skipped +
           world.resource<CloseupSubjects>().subjects.size() + world.resource<CloseupMeshes>().deformed.size();
  };
  draw();
  draw();
  const CloseupShot with = shot();
  ASSERT_EQ(world.view<const CloseupPair>().size(), 2u);
  for (const auto& [knob, off, on] :
       {std::array{"closeups.max_pairs", "0", "8"}, std::array{"shadows.mode", "off", "deferred"}}) {
    set(knob, off);
    draw();
    EXPECT_EQ(left_behind(), 0u) << knob;
    set(knob, on);
    draw();
    expect_same_shots(shot(), with, std::string(knob) + " switched on again");
    EXPECT_EQ(world.view<const CloseupPair>().size(), 2u);
  }
  for (const Entity subject : {left.root, right.root}) world.get<CloseupSubject>(subject).enabled = false;
  draw();
  EXPECT_EQ(left_behind(), 0u) << "no subject";
}

}  // namespace
}  // namespace gloam::test
