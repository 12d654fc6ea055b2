// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "tests/modules/reflections/support/lamp_hall.h"

namespace gloam::test {
namespace {

/// Captures that are made again while frames are drawn.
struct Recaptures : LampHall {
  void SetUp() override {
    LampHall::SetUp();
    if (IsSkipped()) return;
    capture_again();
    set("reflections.tiers", "ibr+cube");
    set("reflections.recapture", "budget");
  }
  /// Passes of the last frame with a name that begins in this way.
  [[nodiscard]] std::size_t passes(std::string_view begin) const {
    const auto report = renderer->report();
    return static_cast<std::size_t>(
        std::ranges::count_if(report.passes, [&](const PassTime& pass) { return pass.name.starts_with(begin); }));
  }
  [[nodiscard]] double counter(const std::string& name) const {
    const auto report = renderer->report();
    const auto found = report.counters.find(name);
    return found == report.counters.end() ? -1.0 : found->second;
  }
  /// Draws frames; returns how many of them have captured a proxy again.
  std::size_t frames(std::size_t count) {
    std::size_t made = 0;
    for (std::size_t i = 0; i < count; ++i) {
      draw();
      const std::size_t copies = passes("reflection_recapture_copy");
      EXPECT_LE(copies, 1u) << "the budget of a frame";
      made += copies;
    }
    return made;
  }
  /// Pixels of the floor whose light differs by more than 5 % from that with new captures.
  [[nodiscard]] double share_unlike_new_captures() {
    const LinearPicture seen = shot();
    capture_again();
    const LinearPicture expected = shot();
    std::size_t unlike = 0, all = 0;
    for (std::uint32_t y = settings.height / 2; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        if (!meets_floor(ray(x, y))) continue;
        ++all;
        unlike += relative_error(pixel(seen, x, y), pixel(expected, x, y), 1.0) > 0.05 ? 1 : 0;
      }
    return static_cast<double>(unlike) / static_cast<double>(all);
  }
};

TEST_F(Recaptures, nothing_is_captured_again_where_nothing_has_changed_enough) {
  EXPECT_EQ(frames(4), 0u);
  EXPECT_EQ(counter("reflections.outdated"), 0.0);
  scale_lamps(3.0f);
  EXPECT_EQ(frames(4), 0u) << "a factor is right";
  EXPECT_EQ(counter("reflections.outdated"), 0.0);
}

TEST_F(Recaptures, proxies_in_view_are_right_after_lamps_have_moved) {
  frames(2);
  move_lamps(12.0);
  set("reflections.recapture", "off");
  EXPECT_EQ(frames(3), 0u);
  const double outdated = counter("reflections.outdated");
  EXPECT_GT(outdated, 10.0);
  const double kept = share_unlike_new_captures();
  EXPECT_GT(kept, 0.1) << "factors are not exact";
  move_lamps(-12.0);
  capture_again();
  set("reflections.recapture", "budget");
  frames(2);
  move_lamps(12.0);
  const std::size_t made = frames(60);
  EXPECT_GT(made, 8u);
  EXPECT_LE(made, 20u) << "each proxy once";
  EXPECT_EQ(frames(3), 0u) << "it ends";
  EXPECT_LT(counter("reflections.outdated"), outdated);
  EXPECT_LT(share_unlike_new_captures(), 0.2 * kept);
}

TEST_F(Recaptures, a_probe_is_captured_again_a_face_or_a_mip_a_frame) {
  set("reflections.tiers", "cube");
  frames(2);
  move_lamps(12.0);
  for (int frame = 0; frame < 20; ++frame) {
    draw();
    EXPECT_LE(passes("reflection_recapture_face") + passes("reflection_recapture_map"), 2u) << "pass and its mips";
    EXPECT_EQ(passes("reflection_recapture_face") * passes("reflection_recapture_map"), 0u);
  }
  EXPECT_EQ(passes("reflection_recapture"), 0u) << "it ends";
  const double light = floor_light();
  const LinearPicture seen = shot();
  capture_again();
  EXPECT_NEAR(floor_light() / light, 1.0, 0.02);
  std::size_t unlike = 0, all = 0;
  const LinearPicture expected = shot();
  for (std::uint32_t y = settings.height / 2; y < settings.height; ++y)
    for (std::uint32_t x = 0; x < settings.width; ++x, ++all)
      unlike += relative_error(pixel(seen, x, y), pixel(expected, x, y), 1.0) > 0.05 ? 1 : 0;
  EXPECT_LT(unlike, all / 20) << "GPU and CPU prefilter alike, each face is where it was";
}

// Hard case: reflections.dark_at_capture
TEST_F(Recaptures, what_was_dark_at_capture_is_lit_within_60_frames) {
  scale_lamps(0.0f);
  capture_again();
  frames(2);
  for (const Entity entity : lamps) world.get<Light>(entity).intensity = 400.0f;
  EXPECT_LE(frames(60), 20u);
  EXPECT_LT(share_unlike_new_captures(), 0.1);
}

TEST_F(Recaptures, lights_that_go_out_are_out_at_once) {
  frames(2);
  scale_lamps(0.0f);
  EXPECT_EQ(frames(2), 0u);
  EXPECT_LT(share_unlike_new_captures(), 0.05);
}

TEST_F(Recaptures, of_new_captures_of_the_world_nothing_is_kept) {
  frames(2);
  move_lamps(12.0);
  EXPECT_GT(frames(30), 8u);
  capture_again();
  EXPECT_EQ(frames(4), 0u);
  EXPECT_EQ(counter("reflections.outdated"), 0.0);
  move_lamps(-12.0);
  frames(60);
  EXPECT_LT(share_unlike_new_captures(), 0.05);
}

TEST_F(Recaptures, a_view_that_sees_no_mirror_captures_nothing) {
  frames(2);
  move_lamps(12.0);
  settings = look_at(dvec3(-10.0, 1.7, 1.0), dvec3(2.0, 4.5, -1.0), 96, 64);
  settings.camera.fov_y = 0.2f;
  EXPECT_LE(frames(1), 1u) << "a capture that the frame before has asked for";
  EXPECT_EQ(frames(4), 0u);
  EXPECT_EQ(passes("reflection"), 0u);
}

/// With shadows, and a wall with a gap across the hall: factors do not know which lamps a wall hides.
struct ShadowedRecaptures : Recaptures {
  [[nodiscard]] bool with_shadows() const override { return true; }
  void SetUp() override {
    Recaptures::SetUp();
    if (IsSkipped()) return;
    for (const double side : {-1.0, 1.0})
      scene.draw(scene.mesh(box(vec3(0.1f, 2.5f, 2.0f), shining(vec3(0.0f)))), at(0.0, 2.5, side * 4.0));
    capture_again();
  }
};

TEST_F(ShadowedRecaptures, are_right_where_a_lamp_has_moved_to_another_room) {
  for (const char* tiers : {"cube", "ibr+cube"}) {
    set("reflections.tiers", tiers);
    frames(2);
    move_lamps(12.0);
    frames(60);
    const double seen = floor_light();
    capture_again();
    EXPECT_NEAR(seen / floor_light(), 1.0, 0.05) << tiers;
    move_lamps(-12.0);
    capture_again();
  }
}

TEST_F(Recaptures, two_views_of_a_world_capture_the_same_probe_together) {
  set("reflections.tiers", "cube");
  std::vector<ViewRequest> requests(2);
  requests[0].settings = requests[1].settings = settings;
  requests[1].settings.id = ViewId{1};
  const auto both = [&] {
    ASSERT_TRUE(renderer->render(world, requests).ok());
    ASSERT_TRUE(renderer->wait().ok());
  };
  both();
  move_lamps(12.0);
  for (int frame = 0; frame < 30; ++frame) both();
  const double light = floor_light();
  capture_again();
  EXPECT_NEAR(floor_light() / light, 1.0, 0.02);
}

TEST_F(Recaptures, lamps_that_move_in_every_frame_stay_within_the_budget) {
  frames(2);
  for (int frame = 0; frame < 30; ++frame) {
    move_lamps(0.4);
    EXPECT_LE(frames(1), 1u);
  }
  frames(60);
  EXPECT_LT(share_unlike_new_captures(), 0.1);
}

TEST_F(Recaptures, proxies_with_an_image_of_their_own_are_left_alone) {
  world.view<IbrProxy>().each([&](IbrProxy& proxy) { proxy.kind = IbrProxyKind::fire; });
  capture_again();
  frames(2);
  move_lamps(12.0);
  EXPECT_EQ(frames(4), 0u);
}

}  // namespace
}  // namespace gloam::test
