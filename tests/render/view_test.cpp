// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <vector>

#include "engine/scene/gltf/import.h"
#include "engine/scene/posing/camera_poses.h"
#include "engine/scene/resources.h"
#include "tests/support/expect_assert.h"
#include "tests/support/render_scene.h"

namespace gloam {
namespace {

ViewSettings looking(const dvec3& eye, const dvec3& target, std::uint32_t width = 640, std::uint32_t height = 360) {
  return test::look_at(eye, target, width, height);
}

dvec4 clip_of(const RenderView& view, const dvec3& world) {
  return dmat4(view.clip_from_relative) * dvec4(dvec3(view.relative(world)), 1.0);
}

TEST(MakeView, depth_is_near_over_distance) {
  const RenderView view = make_view(looking(dvec3(0.0), dvec3(0.0, 0.0, -1.0)), 7);
  EXPECT_EQ(view.frame, 7u);
  for (const double distance : {0.1, 1.0, 25.0, 1000.0}) {
    const dvec4 clip = clip_of(view, dvec3(0.0, 0.0, -distance));
    EXPECT_NEAR(clip.w, distance, 1e-5 * distance);
    EXPECT_NEAR(clip.z / clip.w, 0.1 / distance, 1e-6);
  }
}

TEST(MakeView, right_is_right_and_up_is_up) {
  const RenderView view = make_view(looking(dvec3(3.0, 2.0, 1.0), dvec3(3.0, 2.0, -9.0)), 0);
  EXPECT_GT(clip_of(view, dvec3(4.0, 2.0, -4.0)).x, 0.0);
  EXPECT_GT(clip_of(view, dvec3(3.0, 3.0, -4.0)).y, 0.0);
  EXPECT_LT(clip_of(view, dvec3(3.0, 2.0, 4.0)).w, 0.0) << "what lies behind has negative w";
}

TEST(MakeView, a_point_at_the_edge_of_the_field_of_view_is_at_the_edge_of_the_picture) {
  ViewSettings settings = looking(dvec3(0.0), dvec3(0.0, 0.0, -1.0), 200, 100);
  settings.camera.fov_y = 1.2f;
  const RenderView view = make_view(settings, 0);
  const double half = std::tan(0.5 * static_cast<double>(settings.camera.fov_y));
  const dvec4 clip = clip_of(view, dvec3(2.0 * half * 5.0, half * 5.0, -5.0));
  EXPECT_NEAR(clip.x / clip.w, 1.0, 1e-5);
  EXPECT_NEAR(clip.y / clip.w, 1.0, 1e-5);
}

TEST(MakeView, relative_positions_keep_a_tenth_of_a_millimetre_a_thousand_kilometres_out) {
  const dvec3 eye(1e6, -2e6, 3e6);
  const RenderView view = make_view(looking(eye, eye + dvec3(1.0, 0.2, -3.0)), 0);
  for (const dvec3 offset : {dvec3(0.1234, 5.4321, -10.0001), dvec3(-100.0625, 3.0, 0.0003)}) {
    const vec3 relative = view.relative(eye + offset);
    EXPECT_LT(glm::length(dvec3(relative) - offset), 1e-5);
  }
  const RenderView home = make_view(looking(dvec3(0.0), dvec3(1.0, 0.2, -3.0)), 0);
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      EXPECT_NEAR(view.clip_from_relative[column][row], home.clip_from_relative[column][row], 1e-6f);
}

TEST(MakeView, the_frustum_holds_what_the_picture_shows) {
  const RenderView view = make_view(looking(dvec3(1e5, 0.0, 0.0), dvec3(1e5, 1.0, -4.0)), 0);
  const auto sphere_at = [&](const dvec3& world) { return Sphere{view.relative(world), 0.01f}; };
  EXPECT_TRUE(may_intersect(view.frustum, sphere_at(dvec3(1e5, 1.0, -4.0))));
  EXPECT_FALSE(may_intersect(view.frustum, sphere_at(dvec3(1e5, -1.0, 4.0))));
  EXPECT_FALSE(may_intersect(view.frustum, sphere_at(dvec3(1e5 + 40.0, 1.0, -4.0))));
  EXPECT_TRUE(may_intersect(view.frustum, sphere_at(dvec3(1e5, 1e6, -4e6)))) << "there is no far plane";
}

TEST(MakeView, orthographic_depth_falls_evenly_from_near_to_far) {
  ViewSettings settings = looking(dvec3(0.0), dvec3(0.0, 0.0, -1.0), 400, 200);
  settings.camera.orthographic = true;
  settings.camera.half_height_m = 3.0f;
  settings.camera.near_m = 1.0f;
  settings.camera.far_m = 11.0f;
  const RenderView view = make_view(settings, 0);
  EXPECT_NEAR(clip_of(view, dvec3(0.0, 0.0, -1.0)).z, 1.0, 1e-6);
  EXPECT_NEAR(clip_of(view, dvec3(0.0, 0.0, -6.0)).z, 0.5, 1e-6);
  EXPECT_NEAR(clip_of(view, dvec3(0.0, 0.0, -11.0)).z, 0.0, 1e-6);
  const dvec4 corner = clip_of(view, dvec3(6.0, 3.0, -8.0));
  EXPECT_NEAR(corner.x, 1.0, 1e-6) << "the picture's shape sets the width";
  EXPECT_NEAR(corner.y, 1.0, 1e-6);
  EXPECT_EQ(corner.w, 1.0);
  EXPECT_FALSE(may_intersect(view.frustum, Sphere{vec3(0.0f, 0.0f, -12.0f), 0.5f}));
}

TEST(MakeView, an_orthographic_view_with_exact_width_may_have_oblong_pixels) {
  ViewSettings settings = looking(dvec3(0.0), dvec3(0.0, 0.0, -1.0), 128, 128);
  settings.camera.orthographic = true;
  settings.camera.half_width_m = 3.8f;
  settings.camera.half_height_m = 2.0f;
  settings.exact_width = true;
  const dvec4 corner = clip_of(make_view(settings, 0), dvec3(3.8, 2.0, -8.0));
  EXPECT_NEAR(corner.x, 1.0, 1e-6);
  EXPECT_NEAR(corner.y, 1.0, 1e-6);
}

TEST(MakeView, orthographic_without_a_far_distance_sees_a_kilometre) {
  ViewSettings settings = looking(dvec3(0.0), dvec3(0.0, 0.0, -1.0));
  settings.camera.orthographic = true;
  settings.camera.far_m = 0.0f;
  const RenderView view = make_view(settings, 0);
  EXPECT_GT(clip_of(view, dvec3(0.0, 0.0, -999.0)).z, 0.0);
}

TEST(MakeView, an_empty_picture_asserts) {
  EXPECT_ASSERT((void)make_view(looking(dvec3(0.0), dvec3(0.0, 0.0, -1.0), 0, 5), 0), "at least one pixel");
}

class CameraWorld : public ::testing::Test {
 protected:
  CameraWorld() { prepare_scene_world(world_); }
  [[nodiscard]] Entity camera_at(const dmat4& matrix) {
    Camera camera;
    camera.fov_y = 0.5f;
    camera.near_m = 0.25f;
    return world_.create(WorldTransform{matrix}, camera);
  }
  World world_;
};

TEST_F(CameraWorld, following_takes_pose_and_lens) {
  const dmat4 pose =
      glm::translate(dmat4(1.0), dvec3(5.0, 6.0, 7.0)) * glm::rotate(dmat4(1.0), 0.7, dvec3(0.0, 1.0, 0.0));
  ViewSettings settings;
  settings.camera_entity = camera_at(pose);
  follow_camera(world_, settings);
  EXPECT_EQ(settings.camera.fov_y, 0.5f);
  EXPECT_EQ(settings.camera.near_m, 0.25f);
  for (int column = 0; column < 4; ++column)
    EXPECT_LT(glm::length(settings.world_from_camera[column] - pose[column]), 1e-12);
  EXPECT_EQ(make_view(settings, 0).near_m, 0.25f);
}

TEST_F(CameraWorld, a_view_that_does_not_follow_keeps_its_pose_and_its_cameras_effects) {
  ViewSettings settings = looking(dvec3(1.0, 2.0, 3.0), dvec3(0.0));
  const ViewSettings before = settings;
  settings.camera_entity = camera_at(glm::translate(dmat4(1.0), dvec3(5.0, 6.0, 7.0)));
  settings.follow_camera = false;
  follow_camera(world_, settings);
  EXPECT_EQ(settings.world_from_camera, before.world_from_camera);
  EXPECT_EQ(settings.camera.fov_y, before.camera.fov_y);
  EXPECT_EQ(make_view(settings, 0).camera_entity, settings.camera_entity);
}

TEST_F(CameraWorld, a_scaled_or_mirrored_camera_node_gives_a_rigid_pose) {
  for (const dvec3 scale : {dvec3(3.0), dvec3(0.01, 2.0, 5.0), dvec3(-1.0, 1.0, 1.0), dvec3(1.0, 1.0, 7.0)}) {
    const dmat4 rotation = glm::rotate(dmat4(1.0), 1.1, glm::normalize(dvec3(1.0, 2.0, 3.0)));
    ViewSettings settings;
    settings.camera_entity =
        camera_at(glm::translate(dmat4(1.0), dvec3(1.0, 2.0, 3.0)) * rotation * glm::scale(dmat4(1.0), scale));
    follow_camera(world_, settings);
    const glm::dmat3 axes(settings.world_from_camera);
    EXPECT_NEAR(glm::determinant(axes), 1.0, 1e-9);
    const glm::dmat3 gram = glm::transpose(axes) * axes;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(gram[i][j], i == j ? 1.0 : 0.0, 1e-9);
    EXPECT_LT(glm::length(dvec3(settings.world_from_camera[2]) - dvec3(rotation[2])), 1e-9)
        << "it looks where its node looks";
    EXPECT_EQ(dvec3(settings.world_from_camera[3]), dvec3(1.0, 2.0, 3.0));
  }
}

TEST_F(CameraWorld, a_camera_of_scale_0_has_its_last_pose_or_is_an_input_error) {
  const dmat4 singular = glm::translate(dmat4(1.0), dvec3(4.0)) * glm::scale(dmat4(1.0), dvec3(0.0));
  ViewSettings settings;
  settings.camera_entity = camera_at(singular);
  world_.resource<SceneNames>().add("camera", "eye", settings.camera_entity);
  follow_camera(world_, settings);
  EXPECT_EQ(settings.world_from_camera, dmat4(1.0)) << "no pose to take";
  const Status refused = check_camera_pose(world_, settings);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::input);
  EXPECT_NE(refused.error().message.find("eye"), std::string::npos) << refused.error().message;

  const dmat4 last = glm::translate(dmat4(1.0), dvec3(1.0, 2.0, 3.0));
  world_.resource<CameraPoses>().rows = {{settings.camera_entity, last}};
  EXPECT_TRUE(check_camera_pose(world_, settings).ok());
  follow_camera(world_, settings);
  EXPECT_EQ(settings.world_from_camera, last);
  settings.follow_camera = false;
  world_.resource<CameraPoses>().rows.clear();
  EXPECT_TRUE(check_camera_pose(world_, settings).ok()) << "it does not follow";
}

TEST_F(CameraWorld, nothing_to_follow_leaves_the_settings) {
  ViewSettings settings;
  settings.camera.fov_y = 0.9f;
  follow_camera(world_, settings);
  EXPECT_EQ(settings.camera.fov_y, 0.9f);
  settings.camera_entity = camera_at(dmat4(1.0));
  world_.destroy(settings.camera_entity);
  follow_camera(world_, settings);
  EXPECT_EQ(settings.camera.fov_y, 0.9f);
  settings.camera_entity = world_.create(WorldTransform{});  // has no Camera
  follow_camera(world_, settings);
  EXPECT_EQ(settings.camera.fov_y, 0.9f);
}

TEST_F(CameraWorld, settings_for_a_camera_are_its_own) {
  const Entity camera = camera_at(glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 9.0)));
  const ViewSettings settings = settings_for_camera(world_, camera, 33, 44);
  EXPECT_EQ(settings.camera_entity, camera);
  EXPECT_EQ(settings.width, 33u);
  EXPECT_EQ(settings.height, 44u);
  EXPECT_EQ(dvec3(settings.world_from_camera[3]), dvec3(0.0, 0.0, 9.0));
}

}  // namespace
}  // namespace gloam
