// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/camera/framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <vector>

#include "engine/scene/gltf/import.h"
#include "engine/scene/resources.h"
#include "tests/support/render_scene.h"

namespace gloam {
namespace {

class FramedView : public ::testing::Test {
 protected:
  FramedView() { prepare_scene_world(world_); }

  struct Extent {
    double across = 0.0;  ///< greatest |x| of the picture, 1 at its edge
    double up = 0.0;
    glm::dvec2 middle = glm::dvec2(0.0);  ///< of the outermost points
    double nearness = 0.0;                ///< greatest depth, 1 at the near plane
    bool before_camera = true;
  };
  [[nodiscard]] Extent extent_of(const std::vector<dvec3>& points, std::uint32_t width, std::uint32_t height) const {
    const RenderView view = make_view(framed_view(world_, width, height), 0);
    Extent extent;
    glm::dvec2 least(1e9), most(-1e9);
    for (const dvec3& point : points) {
      const dvec4 clip = dmat4(view.clip_from_relative) * dvec4(dvec3(view.relative(point)), 1.0);
      extent.before_camera = extent.before_camera && clip.w > 0.0;
      extent.across = std::max(extent.across, std::abs(clip.x / clip.w));
      extent.up = std::max(extent.up, std::abs(clip.y / clip.w));
      extent.nearness = std::max(extent.nearness, clip.z / clip.w);
      least = glm::min(least, glm::dvec2(clip) / clip.w);
      most = glm::max(most, glm::dvec2(clip) / clip.w);
    }
    extent.middle = 0.5 * (least + most);
    return extent;
  }
  static void expect_fills(const Extent& extent, const std::string& name) {
    EXPECT_TRUE(extent.before_camera) << name;
    EXPECT_LE(extent.across, 0.91) << name;
    EXPECT_LE(extent.up, 0.91) << name;
    EXPECT_GT(std::max(extent.across, extent.up), 0.89) << name;
    EXPECT_LE(extent.nearness, 1.0) << name;
    EXPECT_NEAR(extent.middle.x, 0.0, 0.02) << name;
    EXPECT_NEAR(extent.middle.y, 0.0, 0.02) << name;
  }
  World world_;
  std::vector<Entity> drawn_;
};

TEST_F(FramedView, shows_all_that_is_drawn_and_little_else) {
  test::SceneMaker scene(world_);
  const std::uint32_t box = scene.mesh(test::box(vec3(0.5f, 2.0f, 0.25f)));
  struct Case {
    dvec3 center;
    double spread;
    std::uint32_t width, height;
  };
  const Case cases[] = {{dvec3(0.0), 1.0, 1280, 720},
                        {dvec3(0.0), 30.0, 300, 900},
                        {dvec3(5.0, -3.0, 8.0), 0.01, 64, 64},
                        {dvec3(0.0), 1e-7, 64, 64},
                        {dvec3(0.0), 1e7, 64, 64},
                        {dvec3(1e6, 2e6, 0.0), 3.0, 50, 400},
                        {dvec3(-1e9, 0.0, 1e9), 2.0, 640, 360}};
  for (const Case& c : cases) {
    for (const Entity old : drawn_) world_.destroy(old);
    drawn_.clear();
    std::vector<dvec3> corners;
    for (int i = 0; i < 5; ++i) {
      const dvec3 offset = c.spread * dvec3(std::sin(2.0 * i), std::cos(3.0 * i), std::sin(5.0 * i + 1.0));
      const dmat4 matrix = glm::translate(dmat4(1.0), c.center + offset) *
                           glm::rotate(dmat4(1.0), 0.9 * i, glm::normalize(dvec3(1.0, i, 2.0))) *
                           glm::scale(dmat4(1.0), dvec3(c.spread));
      drawn_.push_back(scene.draw(box, matrix));
      for (const vec3 p : scene.assets().meshes[box].primitives[0].positions)
        corners.push_back(dvec3(matrix * dvec4(dvec3(p), 1.0)));
    }
    expect_fills(extent_of(corners, c.width, c.height),
                 "spread " + std::to_string(c.spread) + ", width " + std::to_string(c.width));
  }
}

TEST_F(FramedView, looks_from_the_front_and_above) {
  test::SceneMaker scene(world_);
  scene.draw(scene.mesh(test::box(vec3(1.0f))));
  const dvec3 eye(framed_view(world_, 640, 360).world_from_camera[3]);
  EXPECT_GT(eye.z, eye.x);
  EXPECT_GT(eye.x, 0.0);
  EXPECT_GT(eye.y, 0.0);
}

TEST_F(FramedView, shows_a_skinned_mesh_where_its_joints_are) {
  test::SceneMaker scene(world_);
  Primitive box = test::box(vec3(1.0f));
  box.joints.assign(box.positions.size(), {0, 0, 0, 0});
  box.weights.assign(box.positions.size(), vec4(1.0f, 0.0f, 0.0f, 0.0f));
  const std::uint32_t mesh = scene.mesh(box);
  const Entity entity = scene.draw(mesh, glm::translate(dmat4(1.0), dvec3(-500.0, 0.0, 0.0)));
  auto& joints = world_.resource<JointMatrices>();
  joints.matrices = {mat4(glm::scale(dmat4(1.0), dvec3(3.0)))};
  joints.ranges = {{.instance = entity, .first = 0, .count = 1, .origin = dvec3(40.0, 5.0, 0.0)}};
  std::vector<dvec3> corners;
  for (const vec3 p : box.positions) corners.push_back(dvec3(p) * 3.0 + dvec3(40.0, 5.0, 0.0));
  expect_fills(extent_of(corners, 320, 180), "skinned");
}

TEST_F(FramedView, shows_flat_things_and_single_points) {
  test::SceneMaker scene(world_);
  Primitive line = test::box(vec3(0.0f));
  line.positions[0] = vec3(0.0f, 3.0f, 0.0f);
  const Entity entity = scene.draw(scene.mesh(line));
  expect_fills(extent_of({dvec3(0.0), dvec3(0.0, 3.0, 0.0)}, 320, 180), "line");
  world_.destroy(entity);
  scene.draw(scene.mesh(test::box(vec3(0.0f))));
  EXPECT_TRUE(extent_of({dvec3(0.0)}, 320, 180).before_camera);
}

TEST_F(FramedView, of_a_world_without_meshes_is_near_its_origin) {
  const double distance = glm::length(dvec3(framed_view(world_, 64, 64).world_from_camera[3]));
  EXPECT_GT(distance, 0.5);
  EXPECT_LT(distance, 100.0);
}

}  // namespace
}  // namespace gloam
