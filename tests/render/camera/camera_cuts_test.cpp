// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/camera/camera_cuts.h"

#include <gtest/gtest.h>

namespace gloam {
namespace {

struct Cuts : ::testing::Test {
  CameraCuts cuts;
  ViewSettings settings;
  std::uint64_t frame = 10;

  [[nodiscard]] std::uint64_t given_up(std::uint64_t world = 1) {
    cuts.begin_frame();
    return cuts.declare(world, settings, frame);
  }
  /// Whether the camera is cut in the next frame, which is committed.
  [[nodiscard]] bool cut(std::uint64_t world = 1) {
    const bool cut = given_up(world) == frame;
    cuts.commit();
    ++frame;
    return cut;
  }
};

TEST_F(Cuts, the_first_frame_of_a_view_and_a_stated_cut_are_cuts) {
  EXPECT_TRUE(cut());
  EXPECT_FALSE(cut());
  settings.camera_cut = true;
  EXPECT_TRUE(cut());
  settings.camera_cut = false;
  EXPECT_FALSE(cut());
}

TEST_F(Cuts, the_newest_cut_is_remembered) {
  EXPECT_TRUE(cut());
  EXPECT_FALSE(cut());
  EXPECT_EQ(given_up(), 10u);
}

TEST_F(Cuts, another_camera_or_projection_is_a_cut_another_pose_or_lens_is_not) {
  EXPECT_TRUE(cut());
  settings.camera_entity = Entity{3, 1};
  EXPECT_TRUE(cut());
  settings.camera_entity = Entity{3, 2};
  EXPECT_TRUE(cut());
  settings.camera.orthographic = true;
  EXPECT_TRUE(cut());
  settings.camera.fov_y *= 0.5f;
  settings.camera.half_height_m *= 2.0f;
  settings.world_from_camera[3] = dvec4(100.0, 0.0, 0.0, 1.0);
  settings.width = 5;
  EXPECT_FALSE(cut());
}

TEST_F(Cuts, a_cut_in_a_frame_that_is_given_up_is_one_of_the_next_frame) {
  EXPECT_TRUE(cut());
  settings.camera_cut = true;
  EXPECT_EQ(given_up(), frame);
  settings.camera_cut = false;
  EXPECT_EQ(given_up(), frame);
  EXPECT_TRUE(cut());
  EXPECT_FALSE(cut());
  settings.camera_entity = Entity{3, 1};
  EXPECT_EQ(given_up(), frame);
  settings.camera_entity = kNoEntity;
  EXPECT_FALSE(cut()) << "no drawn frame has shown the other camera";
}

TEST_F(Cuts, a_frame_that_is_drawn_again_has_the_cut_that_it_had) {
  EXPECT_TRUE(cut());
  settings.camera_entity = Entity{3, 1};
  EXPECT_TRUE(cut());
  --frame;
  EXPECT_TRUE(cut());
  EXPECT_FALSE(cut());
  settings.camera_cut = true;
  EXPECT_EQ(given_up(), frame);
  settings.camera_cut = false;
  --frame;
  EXPECT_FALSE(cut()) << "the cut is one of the next frame";
  EXPECT_TRUE(cut());
}

TEST_F(Cuts, views_and_worlds_have_their_own_and_can_be_forgotten) {
  EXPECT_TRUE(cut(1));
  EXPECT_TRUE(cut(2));
  settings.id = ViewId{4};
  EXPECT_TRUE(cut(1));
  EXPECT_FALSE(cut(1));
  cuts.forget_view(ViewId{4});
  EXPECT_TRUE(cut(1));
  settings.id = ViewId{0};
  EXPECT_FALSE(cut(2));
  cuts.forget_world(2);
  EXPECT_FALSE(cut(1));
  EXPECT_TRUE(cut(2));
}

}  // namespace
}  // namespace gloam
