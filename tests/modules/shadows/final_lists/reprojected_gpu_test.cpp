// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/modules/shadows/support/reuse_twins.h"

// shadows.reuse=reprojected against a renderer that keeps nothing. Pictures differ where visibilities come from another
// pixel of the frame before; they are equal to the bit again four frames after the camera has stopped.

namespace gloam {
namespace {

using test::Twin;

class ReprojectedShadows : public test::ReuseTwins {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(ReuseTwins::SetUp());
    if (IsSkipped()) return;
    ASSERT_TRUE(keeping_.renderer->knobs().set("shadows.reuse", "reprojected").ok());
  }

  struct Difference {
    double mean = 0.0;   ///< over the mean of the picture
    double share = 0.0;  ///< of values that differ by more than a tenth of the picture's mean
  };
  /// Draws both.
  Difference draw(const std::string& what) {
    std::array<std::vector<float>, 2> pictures;
    draw_pictures(what, pictures);
    double sum = 0.0, difference = 0.0, far = 0.0;
    if (HasFatalFailure() || pictures[0].size() != pictures[1].size() || pictures[0].empty()) {
      ADD_FAILURE() << what << ": no pictures";
      return {};
    }
    for (const float value : pictures[1]) sum += static_cast<double>(value);
    const double mean = sum / static_cast<double>(pictures[1].size());
    for (std::size_t i = 0; i < pictures[0].size(); ++i) {
      const double off = std::abs(static_cast<double>(pictures[0][i]) - static_cast<double>(pictures[1][i]));
      difference += off;
      far += off > 0.1 * mean ? 1.0 : 0.0;
    }
    return {difference / sum, far / static_cast<double>(pictures[0].size())};
  }
  void step_camera(const dvec3& by) {
    settings.world_from_camera = glm::translate(dmat4(1.0), by) * settings.world_from_camera;
  }
  [[nodiscard]] double reprojected() const { return count(keeping_, "shadows.tile_lights_reprojected"); }
  /// Tile lights that cast shadows.
  [[nodiscard]] double casting() const {
    return counted_anew("shadows.tile_lights") - counted_anew("shadows.tile_lights_unshadowed");
  }
  /// Four frames make all tiles anew.
  void expect_exact_after_rest() {
    for (int i = 0; i < 4; ++i) draw("at rest");
    draw_both("after four frames at rest");
    draw_both("and again");
    EXPECT_EQ(reprojected(), 0.0);
    EXPECT_EQ(filtered(), 0.0);
  }
};

TEST_F(ReprojectedShadows, a_moving_camera_takes_half_of_the_visibilities_from_the_frame_before) {
  expect_exact_after_rest();
  for (int i = 0; i < 8; ++i) {
    step_camera(dvec3(0.012, 0.002, -0.006));
    const Difference d = draw("step " + std::to_string(i));
    EXPECT_GT(reprojected(), 0.4 * casting()) << i;
    EXPECT_LT(reprojected(), 0.8 * casting()) << "a quarter is made anew";
    EXPECT_LT(d.mean, 0.01) << i;
    EXPECT_LT(d.share, 0.02) << i;
  }
  expect_exact_after_rest();
}

TEST_F(ReprojectedShadows, what_a_step_uncovers_is_made_anew) {
  // A lit pane above the floor, which is in its shadow: both have the same normal, and differ by their place alone.
  each([](Twin& twin) {
    test::SceneMaker maker(*twin.world);
    const std::uint32_t plain = maker.material(exact_material(180, 170, 160, 255, 0));
    twin.things.push_back(maker.draw(maker.mesh(test::quad(0.5f, plain)), flat(0.6)));
  });
  settings = test::look_at(dvec3(0.3, 1.6, 2.0), dvec3(0.0, 0.3, 0.0), 120, 84);
  expect_exact_after_rest();
  for (int i = 0; i < 6; ++i) {
    step_camera(dvec3(i % 2 == 0 ? 0.25 : -0.25, 0.0, 0.0));
    const Difference d = draw("step " + std::to_string(i));
    EXPECT_GT(reprojected(), 0.0);
    EXPECT_LT(d.mean, 0.0027) << i;
  }
  expect_exact_after_rest();
}

TEST_F(ReprojectedShadows, an_orthographic_camera_that_turns_does_so_as_well) {
  settings.camera.orthographic = true;
  settings.camera.half_height_m = 1.5f;
  for (int i = 0; i < 4; ++i) draw("at rest");
  for (int i = 0; i < 6; ++i) {
    settings.world_from_camera = settings.world_from_camera * glm::rotate(dmat4(1.0), 0.004, dvec3(0.3, 1.0, 0.2));
    const Difference d = draw("turn " + std::to_string(i));
    EXPECT_GT(reprojected(), 0.3 * casting()) << i;
    EXPECT_LT(d.mean, 0.015) << i;
  }
  expect_exact_after_rest();
}

TEST_F(ReprojectedShadows, what_moves_in_a_lights_way_is_seen_at_once) {
  expect_exact_after_rest();
  // The camera rests, so what is taken is taken from the same pixel: only the shadows of what moves can be wrong.
  for (int i = 0; i < 8; ++i) {
    move_thing(1, dvec3(i < 4 ? 0.12 : -0.12, 0.0, 0.06));
    const Difference d = draw("caster " + std::to_string(i));
    EXPECT_LT(d.mean, 0.0005) << i;
    EXPECT_LT(d.share, 0.0005) << i;
    EXPECT_GT(reprojected() + kept(), 0.2 * casting()) << i;
  }
  expect_exact_after_rest();
  // Lamps that move or change take nothing, and those that rest nothing wrong.
  for (int i = 0; i < 3; ++i) {
    move_lamp(0, dvec3(0.05, 0.0, 0.02));
    draw_both("lamp " + std::to_string(i));
  }
  change_lamp(1, [](Light& l) { l.width_m = 0.2f; });
  draw_both("width");
  expect_exact_after_rest();
}

TEST_F(ReprojectedShadows, cuts_sizes_and_frames_that_are_given_up_leave_nothing_wrong) {
  expect_exact_after_rest();
  settings.camera_cut = true;
  step_camera(dvec3(0.8, 0.3, -0.2));
  EXPECT_LT(draw("cut").mean, 0.02);
  settings.camera_cut = false;
  step_camera(dvec3(-2.0, 0.2, 0.5));
  EXPECT_LT(draw("a jump without a cut").mean, 0.02);
  step_camera(dvec3(0.01, 0.0, 0.0));
  give_up();
  move_thing(1, dvec3(0.3, 0.0, 0.0));
  give_up();
  EXPECT_LT(draw("after frames that were given up").mean, 0.02);
  settings.width = 61;
  settings.height = 43;
  draw_both("another size");
  expect_exact_after_rest();
  step_camera(dvec3(0.01, 0.0, 0.0));
  draw("step");
  EXPECT_TRUE(keeping_.renderer->knobs().set("shadows.reuse", "exact").ok());
  draw_both("exact: what was reprojected is made anew");
  draw_both("exact, again");
}

TEST_F(ReprojectedShadows, pictures_that_accumulate_under_jitter_take_nothing) {
  both("lighting.antialiasing", "taa");
  for (int i = 0; i < 4; ++i) {
    step_camera(dvec3(0.01, 0.0, 0.0));
    draw_both("step " + std::to_string(i));
    if (i > 0) {  // the first frame after a cut has no jitter
      EXPECT_EQ(reprojected(), 0.0);
    }
  }
}

TEST_F(ReprojectedShadows, random_changes_leave_small_errors_that_end) {
  std::mt19937 random(11);
  const auto some = [&](double most) { return std::uniform_real_distribution<double>(-most, most)(random); };
  double worst = 0.0, sum = 0.0, taken = 0.0;
  for (int i = 0; i < 60; ++i) {
    const dvec3 by(some(0.06), some(0.02), some(0.06));
    switch (random() % 6) {
      case 0:
        move_thing(1 + random() % 3, by);
        break;
      case 1:
        move_lamp(random() % 4, by);
        break;
      case 2:
        give_up();
        [[fallthrough]];
      default:
        step_camera(0.3 * by);
        break;
    }
    const double mean = draw("change " + std::to_string(i)).mean;
    worst = std::max(worst, mean);
    sum += mean;
    taken += reprojected();
  }
  EXPECT_GT(taken, 1000.0);
  EXPECT_LT(worst, 0.03);
  EXPECT_LT(sum / 60.0, 0.01);
  expect_exact_after_rest();
}

}  // namespace
}  // namespace gloam
