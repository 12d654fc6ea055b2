// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/display/resolution_scale.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace gloam {
namespace {

constexpr double kRest = 45.0, kMoving = 80.0;
constexpr ResolutionScale::Budget kBudget{kRest, kMoving};

/// A scene whose frames take `fixed_ms`, and `full_ms` more at scale 1.
struct Scene {
  double fixed_ms = 10.0;
  double full_ms = 500.0;
  [[nodiscard]] double frame_ms(double scale) const { return fixed_ms + full_ms * scale * scale; }
};

/// Draws frames and returns the number of changes.
int draw(ResolutionScale& scale, const Scene& scene, int frames, bool moving = true) {
  int changes = 0;
  for (int i = 0; i < frames; ++i) changes += scale.add(scene.frame_ms(scale.scale()), moving) ? 1 : 0;
  return changes;
}

TEST(ResolutionScaleTest, a_fixed_scale_stays) {
  ResolutionScale scale(kBudget, 0.37);
  scale.start(1280, 720, 1000.0);
  EXPECT_EQ(draw(scale, {}, 100), 0);
  EXPECT_EQ(scale.scale(), 0.37);
}

TEST(ResolutionScaleTest, starts_at_the_largest_step_within_the_pixels) {
  ResolutionScale scale(kBudget, 0.0);
  scale.start(1280, 720, 1280.0 * 720.0 * 0.36 + 1.0);
  EXPECT_EQ(scale.scale(), 0.6);
  scale.start(160, 90, 100000.0);
  EXPECT_EQ(scale.scale(), 1.0);
  scale.start(3840, 2160, 1.0);
  EXPECT_EQ(scale.scale(), 0.25);
}

TEST(ResolutionScaleTest, finds_a_scale_within_the_budget_and_stays_there) {
  for (const Scene scene : {Scene{10.0, 500.0}, Scene{30.0, 300.0}, Scene{2.0, 900.0}, Scene{1.0, 20.0}}) {
    for (const double most_pixels : {1.0, 110000.0, 1e9}) {
      ResolutionScale scale(kBudget, 0.0);
      scale.start(1280, 720, most_pixels);
      EXPECT_LE(draw(scale, scene, 60), 6);
      EXPECT_LE(scene.frame_ms(scale.scale()), kMoving) << scene.full_ms;
      EXPECT_LE(draw(scale, scene, 300), 1) << "it must not swing";
      if (scene.full_ms == 20.0) {
        EXPECT_EQ(scale.scale(), 1.0);
      }
    }
  }
}

TEST(ResolutionScaleTest, a_camera_at_rest_has_a_budget_of_its_own) {
  const Scene slow{10.0, 500.0};
  ResolutionScale rest(kBudget, 0.0);
  rest.start(1280, 720, 110000.0);
  draw(rest, slow, 60, false);
  EXPECT_LE(slow.frame_ms(rest.scale()), kRest);
  // Frames at rest that take half of the time of moving ones: one scale serves both.
  ResolutionScale both(kBudget, 0.0);
  both.start(1280, 720, 110000.0);
  const Scene kept{0.5 * slow.fixed_ms, 0.5 * slow.full_ms};
  draw(both, slow, 60, true);
  draw(both, kept, 60, false);
  int changes = 0;
  for (int i = 0; i < 20; ++i) changes += draw(both, slow, 20, true) + draw(both, kept, 20, false);
  EXPECT_EQ(changes, 0);
}

TEST(ResolutionScaleTest, a_single_slow_frame_changes_nothing) {
  ResolutionScale scale(kBudget, 0.0);
  scale.start(1280, 720, 110000.0);
  draw(scale, {}, 60);
  const double before = scale.scale();
  scale.add(1000.0, true);
  EXPECT_EQ(draw(scale, {}, 20), 0);
  EXPECT_EQ(scale.scale(), before);
}

TEST(ResolutionScaleTest, follows_a_scene_that_becomes_slower_and_faster) {
  ResolutionScale scale(kBudget, 0.0);
  scale.start(1280, 720, 110000.0);
  draw(scale, {10.0, 100.0}, 60);
  EXPECT_GE(scale.scale(), 0.7);
  draw(scale, {20.0, 800.0}, 30);
  EXPECT_LE(scale.scale(), 0.3);
  draw(scale, {10.0, 50.0}, 1000);
  EXPECT_EQ(scale.scale(), 1.0) << "a blocked step is tried again later";
}

TEST(ResolutionScaleTest, a_step_that_was_slow_only_at_first_is_tried_again_soon) {
  ResolutionScale scale(kBudget, 0.0);
  scale.start(1280, 720, 116000.0);
  const double first = scale.scale();
  for (int frame = 0; frame < 6; ++frame) scale.add(120.0, true);
  ASSERT_LT(scale.scale(), first);
  draw(scale, {10.0, 200.0}, 40);
  EXPECT_GT(scale.scale(), first);
}

TEST(ResolutionScaleTest, a_scene_that_is_too_slow_at_every_scale_stays_at_the_smallest) {
  ResolutionScale scale(kBudget, 0.0);
  scale.start(1280, 720, 1e9);
  draw(scale, {200.0, 5000.0}, 100);
  EXPECT_EQ(scale.scale(), 0.25);
}

TEST(ResolutionScaleTest, can_be_fixed_and_freed_while_it_runs) {
  ResolutionScale scale(kBudget, 0.0);
  scale.start(1280, 720, 110000.0);
  const double automatic = scale.scale();
  scale.set(1.0);
  EXPECT_EQ(scale.scale(), 1.0);
  EXPECT_EQ(draw(scale, {}, 50), 0);
  scale.set(0.0);
  EXPECT_EQ(scale.scale(), automatic);
}

}  // namespace
}  // namespace gloam
