// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/modules/grass/support/stems.h"
#include "tests/support/scale.h"

namespace gloam::test {
namespace {

/// Fields of which a view shows a part at a time.
class GrassResidence : public GrassTest {
 protected:
  static constexpr double kFrame = 1.0 / 60.0;
  static constexpr double kLongFrame = 1.0 / 15.0;  // as many steps as a frame may have

  [[nodiscard]] static ViewSettings away() { return look_at({0.1, 0.45, 1.3}, {0.0, 0.45, 9.0}, 96, 64); }
  /// A camera over a place.
  [[nodiscard]] static ViewSettings over(double x, double z, double height_m = 3.0) {
    return look_at({x, height_m, z + 0.01}, {x, 0.0, z}, 64, 48);
  }
  static void expect_sound(GrassStage& stage, const ViewSettings& view, std::size_t least) {
    const GrassPicture picture = grass_picture(stage, view);
    EXPECT_GT(picture.grass_pixels(), least);
    expect_grass_on_stems(picture, stems_of(stage.field(), stage.copy(), picture.with.view.position), 1.0, 0.03);
  }
};

TEST_F(GrassResidence, a_patch_that_slept_is_within_5_mm_when_its_swing_has_decayed) {
  for (const int asleep : some_of<int>({1, 25})) {
    GrassStage watched, slept;
    for (GrassStage* stage : {&watched, &slept}) {
      stage->lawn(0.6f, 300);
      stage->wind(vec3(6.0f, 0.0f, 2.0f), 1.0f);
      stage->set("grass.cast_distance", "0");
      stage->run_at(kLongFrame);
      stage->draw(front(), 6);
    }
    EXPECT_EQ(knot_distance(watched.copy().live_knots(watched.field()), slept.copy().live_knots(slept.field())), 0.0);
    watched.draw(front(), asleep);
    slept.draw(away(), asleep);
    EXPECT_FALSE(slept.has_grass());
    slept.draw(front());
    watched.draw(front());
    EXPECT_GT(knot_distance(watched.copy().live_knots(watched.field()), slept.copy().live_knots(slept.field())), 0.0);
    watched.draw(front(), 60);  // 4 s
    slept.draw(front(), 60);
    EXPECT_LT(knot_distance(watched.copy().live_knots(watched.field()), slept.copy().live_knots(slept.field())), 0.005)
        << "after " << asleep << " frames of sleep";
  }
}

TEST_F(GrassResidence, a_blade_that_returns_does_not_jump) {
  GrassStage stage;
  stage.lawn(0.6f, 600);
  stage.wind(vec3(6.0f, 0.0f, 2.0f), 1.0f);
  stage.set("grass.cast_distance", "0");
  stage.run_at(kFrame);
  stage.draw(front(), 10);
  LiveKnots before = stage.copy().live_knots(stage.field());
  stage.draw(away(), 20);
  for (int frame = 0; frame < 10; ++frame) {
    stage.draw(front());
    const LiveKnots now = stage.copy().live_knots(stage.field());
    // A knot moves at most 30 lengths a second: two steps of a blade of 0.6 m.
    EXPECT_LT(knot_distance(before, now), 2.0 * 30.0 * 0.6 / 120.0);
    before = now;
  }
}

TEST_F(GrassResidence, buffers_that_grow_keep_the_knots) {
  GrassStage stage;
  GrassSurface values;
  values.max_distance_m = 100.0f;
  stage.lawn(8.0f, 100 * 256, dvec3(0.0), values);
  stage.wind(vec3(5.0f, 0.0f, 1.0f), 0.5f);
  stage.set("grass.cast_distance", "0");
  stage.set("grass.lod_pixels", "4");
  stage.run_at(kFrame);
  stage.draw(over(0.0, 0.0), 8);
  stage.run_at(0.0);
  stage.draw(over(0.0, 0.0));
  const GrassCopy few = stage.copy();
  ASSERT_LE(few.patches.size(), GrassResidency::kFewest);
  stage.draw(over(0.0, 0.0, 14.0));
  const GrassCopy many = stage.copy();
  ASSERT_GT(many.patches.size(), GrassResidency::kFewest);
  EXPECT_GT(many.knots.size(), few.knots.size());
  stage.draw(over(0.0, 0.0));
  const GrassCopy again = stage.copy();
  const LiveKnots before = few.live_knots(stage.field());
  EXPECT_GT(before.size(), 20u);
  EXPECT_TRUE(again.live_knots(stage.field()) == before);
  EXPECT_EQ(again.knots.size(), many.knots.size());
  EXPECT_EQ(again.dispatch.masters, 0u);
}

TEST_F(GrassResidence, buffers_that_grow_for_the_second_view_of_a_frame_keep_the_knots_of_the_first) {
  GrassStage alone, both;
  for (GrassStage* stage : {&alone, &both}) {
    stage->lawn(8.0f, 100 * 256);
    stage->wind(vec3(5.0f, 0.0f, 1.0f), 0.5f);
    stage->set("grass.cast_distance", "0");
    stage->set("grass.lod_pixels", "4");
    stage->run_at(kFrame);
    stage->draw(over(0.0, 0.0), 4);
  }
  ViewSettings views[] = {over(0.0, 0.0), over(0.0, 0.0, 14.0)};
  views[1].id = ViewId{1};
  for (int frame = 0; frame < 3; ++frame) {
    alone.draw(over(0.0, 0.0));
    both.draw(views);
    EXPECT_TRUE(both.copy().live_knots(both.field()) == alone.copy().live_knots(alone.field())) << "frame " << frame;
    EXPECT_EQ(knot_distance(both.copy(ViewId{1}).live_knots(both.field()), alone.copy().live_knots(alone.field())), 0.0)
        << "frame " << frame;
  }
}

TEST_F(GrassResidence, patches_come_and_go_along_a_walk) {
  GrassStage stage;
  GrassSurface values;
  values.width_m = 0.02f;
  stage.lawn(14.0f, 130 * 256, dvec3(0.0), values);
  stage.wind(vec3(5.0f, 0.0f, 1.0f), 0.5f);
  stage.set("grass.cast_distance", "0");
  stage.set("grass.segments", "full");  // blades are compared with their stems
  stage.run_at(kFrame);
  const int places = scaled(12);
  for (int place = 0; place < places; ++place) {
    SCOPED_TRACE(place);
    const double x = 11.0 * std::sin(2.4 * place), z = 11.0 * std::cos(1.7 * place);
    stage.run_at(kFrame);
    stage.draw(over(x, z), 2);
    EXPECT_LE(stage.copy().patches.size(), GrassResidency::kFewest);
    EXPECT_EQ(stage.copy().knots.size(), std::size_t{GrassResidency::kFewest} * stage.copy().slot_masters * 16)
        << "memory follows what is live";
    stage.run_at(0.0);
    expect_sound(stage, over(x, z), 30);
  }
}

TEST_F(GrassResidence, grass_is_back_after_its_memory_was_released) {
  GrassStage stage;
  stage.lawn(0.6f, 400);
  stage.set("grass.cast_distance", "0");
  stage.draw(front());
  const std::vector<float> first = stage.linear().rgba;
  stage.draw(away(), 130);
  stage.draw(front());
  EXPECT_EQ(differences(stage.linear().rgba, first), 0u) << "after 130 frames without grass in view";
  stage.renderer->release_world(stage.world);
  stage.draw(front());
  EXPECT_EQ(differences(stage.linear().rgba, first), 0u) << "after the world was released";
}

TEST_F(GrassResidence, grass_of_a_world_is_back_after_another_world_was_drawn_for_long) {
  GrassStage stage;
  stage.lawn(0.6f, 400);
  stage.draw(front());
  const std::vector<float> first = stage.linear().rgba;
  World other;
  stage.renderer->prepare_world(other);
  SceneMaker maker(other);
  const Entity lawn = maker.draw(maker.mesh(quad(0.6f)), GrassStage::lying(dvec3(0.0)));
  GrassSurface values;
  values.density = 200.0f;
  values.seed = 7;
  other.add(lawn, values);
  for (int i = 0; i < 130; ++i) {
    const ViewRequest request{front(), {}};
    ASSERT_TRUE(stage.renderer->render(other, std::span(&request, 1)).ok());
  }
  stage.draw(front());
  EXPECT_EQ(differences(stage.linear().rgba, first), 0u);
  stage.renderer->release_world(other);
}

TEST_F(GrassResidence, a_regrown_field_replaces_the_old_one) {
  GrassStage stage;
  const Entity lawn = stage.lawn(0.6f, 400);
  stage.set("grass.lod_pixels", "0");
  stage.set("grass.segments", "full");  // blades are compared with their stems
  stage.wind(vec3(5.0f, 0.0f, 1.0f), 0.5f);
  for (const char* masters : some_of<const char*>({"1:4", "1:1", "1:16", "1:4"}))
    for (const std::uint32_t seed : {1u, 2u}) {
      stage.set("grass.masters", masters);
      stage.world.get<GrassSurface>(lawn).seed = seed;
      stage.run_at(kFrame);
      stage.draw(front(), 3);
      stage.run_at(0.0);
      expect_sound(stage, front(), 300);
    }
}

TEST_F(GrassResidence, a_blade_that_a_host_changes_is_drawn_as_changed) {
  GrassStage stage;
  stage.set("grass.lod_pixels", "0");
  stage.lawn(0.6f, 200);
  stage.draw(front());
  const std::uint32_t live = stage.copy().draws.live;
  std::vector<Entity> blades;
  stage.world.view<const GrassBlade, With<GrassSlaveTag>>().each(
      [&](Entity entity, const GrassBlade&) { blades.push_back(entity); });
  ASSERT_GT(blades.size(), 60u);
  for (std::size_t i = 0; i < 50; ++i) stage.world.destroy(blades[i]);
  stage.draw(front());
  EXPECT_EQ(stage.copy().draws.live, live - 50);
}

}  // namespace
}  // namespace gloam::test
