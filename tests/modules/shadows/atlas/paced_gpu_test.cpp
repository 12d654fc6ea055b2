// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "modules/shadows/atlas/paced_sizes.h"
#include "tests/modules/shadows/support/shadowed_scene.h"

namespace gloam {
namespace {

/// A wall under many lamps, whose maps a time budget makes larger and smaller.
class PacedShadows : public test::ShadowedScene {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(ShadowedScene::SetUp());
    if (IsSkipped()) return;
    settings = test::look_at(dvec3(0.4, 0.3, 3.0), dvec3(0.0), 190, 126);
    for (int i = 0; i < 6; ++i) box(dvec3(-1.5 + 0.6 * i, 0.2 * (i % 3), 0.3), dvec3(0.12));
    for (int i = 0; i < 24; ++i) {
      const std::string name = "lamp " + std::to_string(i);
      const Entity bulb = lamp(name, LightKind::spot, dvec3(-2.0 + 0.17 * i, 0.5 - 0.04 * i, 1.2));
      world.get<ShadowCaster>(bulb).resolution = 0;
    }
  }
  /// A front of two settings, and which of them the next frames have.
  void choose(const char* cheap, const char* exact, const char* knob, bool is_exact) {
    FrameBudget budget{.ms = is_exact ? std::numeric_limits<double>::infinity() : 1.0};
    budget.front = {{1.0, 0.5, {{knob, cheap}}}, {2.0, 0.0, {{knob, exact}}}};
    const Status set = renderer->set_budget(std::move(budget));
    ASSERT_TRUE(set.ok()) << set.error().message;
  }
  /// Draws until no face waits. Returns the texels that each frame drew.
  std::vector<double> draw_until_done() {
    std::vector<double> texels;
    do {
      draw();
      texels.push_back(counter("shadows.texels_drawn"));
    } while (!HasFatalFailure() && counter("shadows.faces_waiting") > 0.0 && texels.size() < 100);
    return texels;
  }
  /// Expects the picture that a renderer without a budget draws with these settings.
  void expect_settled_picture() {
    const LinearPicture paced = drawn();
    renderer->clear_budget("");
    EXPECT_EQ(drawn().rgba, paced.rgba);
  }
};

TEST_F(PacedShadows, maps_change_their_sizes_over_frames_and_the_last_picture_is_right) {
  for (const bool larger : {true, false}) {
    choose("1", "6", "shadows.texels_per_pixel", !larger);
    draw_until_done();
    choose("1", "6", "shadows.texels_per_pixel", larger);
    const std::vector<double> texels = draw_until_done();
    double all = 0.0;
    for (const double drawn : texels) all += drawn;
    EXPECT_GE(texels.size(), 8u) << larger;
    for (const double drawn : texels) EXPECT_LE(drawn, all / 6.0) << larger;
    draw();
    EXPECT_EQ(counter("shadows.texels_drawn"), 0.0);
    expect_settled_picture();
  }
}

TEST_F(PacedShadows, shadows_that_are_switched_on_come_over_frames) {
  choose("off", "deferred", "shadows.mode", false);
  draw();
  draw();
  choose("off", "deferred", "shadows.mode", true);
  const std::vector<double> texels = draw_until_done();
  EXPECT_GE(texels.size(), 8u);
  double all = 0.0;
  for (const double drawn : texels) all += drawn;
  for (const double drawn : texels) EXPECT_LE(drawn, all / 6.0);
  expect_settled_picture();
}

TEST_F(PacedShadows, the_first_frame_and_a_new_lamp_have_all_their_maps) {
  choose("1", "6", "shadows.texels_per_pixel", true);
  draw();
  EXPECT_EQ(counter("shadows.faces_waiting"), 0.0);
  EXPECT_EQ(counter("shadows.faces_drawn") + counter("shadows.faces_skipped"), 24.0);
  const Entity added = lamp("added", LightKind::spot, dvec3(0.3, 0.6, 1.5));
  world.get<ShadowCaster>(added).resolution = 0;
  draw();
  EXPECT_EQ(counter("shadows.faces_waiting"), 0.0);
  EXPECT_EQ(counter("shadows.faces_drawn") + counter("shadows.faces_skipped"), 1.0);
  expect_settled_picture();
}

TEST_F(PacedShadows, frames_in_which_maps_wait_are_not_judged) {
  choose("1", "6", "shadows.texels_per_pixel", true);
  draw_until_done();
  choose("1", "6", "shadows.texels_per_pixel", false);
  for (int frame = 0; frame < 4; ++frame) {
    draw();
    ASSERT_GT(counter("shadows.faces_waiting"), 0.0);
    EXPECT_FALSE(renderer->add_frame_time({.ms = 0.01})->changed());
  }
  EXPECT_EQ(renderer->budget()->measured_ms, 0.0);
  draw_until_done();
  for (int frame = 0; frame < 4; ++frame) {
    draw();
    static_cast<void>(renderer->add_frame_time({.ms = 0.01}));
  }
  EXPECT_EQ(renderer->budget()->measured_ms, 0.01);
}

}  // namespace
}  // namespace gloam
