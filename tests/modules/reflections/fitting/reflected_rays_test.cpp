// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/fitting/reflected_rays.h"

#include <algorithm>

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>

#include "tests/modules/reflections/fitting/fit_scene.h"

namespace gloam {
namespace {

/// A puddle of 2 m × 2 m around the origin on a large floor, a wall at z = −5, and a screen that hides half of the
/// puddle from cameras at +z.
struct PuddleScene {
  FitTriangles puddle = test::rectangle({-1.0, 0.01, -1.0}, {0.0, 0.0, 2.0}, {2.0, 0.0, 0.0});
  std::vector<FitTriangles> meshes = {puddle,
                                      test::rectangle({-50.0, 0.0, -50.0}, {0.0, 0.0, 100.0}, {100.0, 0.0, 0.0}),
                                      test::wall(-50.0, 0.0, 100.0, 2.0, -5.0), test::wall(-1.0, 0.0, 1.0, 9.0, 2.0)};
  UpTriangles receivers{test::up_triangles(puddle)};
  UpTriangles ground{test::up_triangles(meshes[1])};
};

RayCamera camera_at(const dvec3& eye, const dvec3& target) {
  RayCamera camera;
  camera.world_from_camera = glm::inverse(glm::lookAt(eye, target, dvec3(0.0, 1.0, 0.0)));
  return camera;
}

TEST(ReflectedRays, start_on_visible_receivers_and_are_mirrored) {
  const PuddleScene scene;
  const RayCamera camera = camera_at({0.0, 1.7, 4.0}, dvec3(0.0));
  const auto rays =
      camera_rays(std::span(&camera, 1), scene.receivers, {.pixels_a_camera = 4096}, test::brute_force(scene.meshes));
  ASSERT_GT(rays.size(), 100u);
  for (const ReflectedRay& ray : rays) {
    EXPECT_EQ(ray.eye, dvec3(0.0, 1.7, 4.0));
    EXPECT_NEAR(ray.receiver.y, 0.01, 1e-9);
    EXPECT_LE(std::max(std::abs(ray.receiver.x), std::abs(ray.receiver.z)), 1.0 + 1e-6);
    const dvec3 view = glm::normalize(ray.receiver - ray.eye);
    EXPECT_LT(glm::length(dvec3(view.x, -view.y, view.z) - ray.direction), 1e-9);
    EXPECT_FALSE(ray.receiver.x < -0.6 && ray.receiver.x > -0.4) << "behind the screen";
    const double traced = test::nearest_hit(scene.meshes, ray.receiver + dvec3(0.0, 1e-3, 0.0), ray.direction);
    EXPECT_EQ(std::isfinite(ray.hit_m), std::isfinite(traced));
    if (!std::isfinite(traced)) continue;
    EXPECT_NEAR(ray.hit_m, traced, 1e-9);
  }
}

TEST(ReflectedRays, are_none_where_no_receiver_is_seen) {
  const PuddleScene scene;
  const auto trace = test::brute_force(scene.meshes);
  for (const dvec3& target : {dvec3(0.0, 3.0, -4.0), dvec3(30.0, 0.0, 30.0)}) {
    const RayCamera camera = camera_at({0.0, 1.7, 3.0}, target);
    EXPECT_TRUE(camera_rays(std::span(&camera, 1), scene.receivers, {.pixels_a_camera = 256}, trace).empty());
  }
  EXPECT_TRUE(camera_rays({}, scene.receivers, {}, trace).empty());
  const RayCamera camera = camera_at({0.0, 1.7, 3.0}, dvec3(0.0));
  EXPECT_TRUE(camera_rays(std::span(&camera, 1), UpTriangles({}), {.pixels_a_camera = 256}, trace).empty());
}

TEST(RandomEyes, stand_on_the_ground_with_headroom) {
  PuddleScene scene;
  // A table over a part of the ground: no eye fits below it.
  scene.meshes.push_back(test::box({4.0, 1.0, -40.0}, {40.0, 1.2, 40.0}));
  const auto eyes = random_eyes(scene.ground, scene.receivers, {.eyes = 300}, test::brute_force(scene.meshes));
  ASSERT_GT(eyes.size(), 100u);
  ASSERT_LT(eyes.size(), 280u);
  for (const RayCamera& eye : eyes) {
    const dvec3 at(eye.world_from_camera[3]);
    EXPECT_NEAR(at.y, 1.7, 0.01);
    EXPECT_LE(glm::length(at), 42.0);
    EXPECT_FALSE(at.x > 4.0 && at.x < 40.0 && std::abs(at.z) < 40.0);
    EXPECT_NEAR(glm::length(dvec3(eye.world_from_camera[2])), 1.0, 1e-9);
    EXPECT_GT(eye.world_from_camera[1].y, 0.8) << "upright";
    const dvec3 ahead = -dvec3(eye.world_from_camera[2]);
    EXPECT_GT(glm::dot(ahead, glm::normalize(-at)), 0.5) << "looks at the puddle";
  }
}

TEST(RandomEyes, of_another_sequence_are_others_and_of_the_same_are_the_same) {
  const PuddleScene scene;
  const auto trace = test::brute_force(scene.meshes);
  const auto first = random_eyes(scene.ground, scene.receivers, {.eyes = 50, .sequence = 1}, trace);
  const auto again = random_eyes(scene.ground, scene.receivers, {.eyes = 50, .sequence = 1}, trace);
  const auto other = random_eyes(scene.ground, scene.receivers, {.eyes = 50, .sequence = 2}, trace);
  ASSERT_EQ(first.size(), again.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].world_from_camera, again[i].world_from_camera);
  for (const RayCamera& a : first)
    for (const RayCamera& b : other) EXPECT_NE(a.world_from_camera[3], b.world_from_camera[3]);
}

TEST(RandomEyes, need_ground_and_receivers) {
  const PuddleScene scene;
  const auto trace = test::brute_force(scene.meshes);
  EXPECT_TRUE(random_eyes(UpTriangles({}), scene.receivers, {.eyes = 9}, trace).empty());
  EXPECT_TRUE(random_eyes(scene.ground, UpTriangles({}), {.eyes = 9}, trace).empty());
  EXPECT_TRUE(random_eyes(scene.ground, scene.receivers, {.eyes = 0}, trace).empty());
}

}  // namespace
}  // namespace gloam
