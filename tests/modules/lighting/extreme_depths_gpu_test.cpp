// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/modules/lighting/lit_scene.h"

// Surfaces whose depth is exactly 1 or exactly 0, and triangles that the near plane cuts.

namespace gloam {
namespace {

class ExtremeDepths : public test::LitSceneTest {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(LitSceneTest::SetUp());
    if (IsSkipped()) return;
    environment().sky_zenith = environment().sky_horizon = environment().sky_ground = vec3(0.0f, 0.25f, 0.0f);
    settings.world_from_camera = glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 3.0));
    Light lamp;
    lamp.intensity = 2.0f;
    lamp.range_m = 9.0f;
    light(lamp, dvec3(0.3, 0.2, 4.0));
    lamp.kind = LightKind::directional;
    light(lamp, dvec3(0.0), dvec3(0.1, -0.2, -1.0));
  }
  [[nodiscard]] bool with_shadows() const override { return true; }
  /// A wall at right angles to the view, wider than the picture.
  void wall(double distance) {
    const std::uint32_t mesh = scene.mesh(test::quad(16.0f, scene.material(exact_material(180, 170, 160, 200, 0))));
    scene.draw(mesh, glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 3.0 - distance)));
  }
  [[nodiscard]] LinearPicture shot() {
    draw();
    return linear();
  }
  [[nodiscard]] std::vector<float> depths() {
    return test::value_of(renderer->read_geometry(world, settings.id)).depth;
  }
  static double most_apart(const LinearPicture& a, const LinearPicture& b) {
    EXPECT_EQ(a.rgba.size(), b.rgba.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
      const auto one = static_cast<double>(a.rgba[i]), other = static_cast<double>(b.rgba[i]);
      worst = test::worse(worst, std::abs(one - other) / std::max(other, 1e-2));
    }
    return worst;
  }
  static double brightest_red(const LinearPicture& picture) {
    double most = 0.0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
      most = std::max(most, static_cast<double>(picture.rgba[i]));
    return most;
  }
};

// Hard case: further.depth_1
TEST_F(ExtremeDepths, a_wall_at_the_near_plane_is_lit_as_with_a_nearer_plane) {
  wall(0.5);
  for (const bool orthographic : {false, true}) {
    settings.camera.orthographic = orthographic;
    settings.camera.far_m = orthographic ? 8.5f : 0.0f;
    settings.camera.near_m = 0.25f;
    const LinearPicture usual = shot();
    EXPECT_GT(brightest_red(usual), 0.05);
    settings.camera.near_m = 0.5f;
    EXPECT_LE(most_apart(shot(), usual), 4e-3) << (orthographic ? "orthographic" : "perspective");
    for (const float depth : depths()) ASSERT_EQ(depth, 1.0f);
  }
}

// Hard case: further.depth_0
TEST_F(ExtremeDepths, a_wall_at_the_far_end_of_an_orthographic_view_is_sky) {
  settings.camera.orthographic = true;
  settings.camera.near_m = 0.5f;
  settings.camera.far_m = 8.5f;
  const LinearPicture sky = shot();
  EXPECT_EQ(brightest_red(sky), 0.0);
  wall(8.5);  // its depth is exactly 0
  EXPECT_EQ(shot().rgba, sky.rgba);
  wall(8.499);
  const LinearPicture lit = shot();
  for (std::size_t i = 0; i < lit.rgba.size(); i += 4) ASSERT_GT(lit.rgba[i], 0.01f) << i / 4;
}

/// A sheet that leans through the near plane: rays meet it before the plane in one part of the picture, where it is cut
/// away, and behind it in the other.
// Hard case: further.huge_triangle
TEST_F(ExtremeDepths, huge_triangles_through_the_near_plane_are_cut_where_rays_say) {
  Material red = exact_material(0, 0, 0, 255, 0);
  red.emissive = vec3(1.0f, 0.0f, 0.0f);
  red.double_sided = true;
  const std::uint32_t material = scene.material(red);
  Primitive triangle = test::quad(1e7f, material);
  triangle.indices = {0, 1, 2};
  triangle.positions[2] = vec3(0.0f, 3e7f, 0.0f);
  const std::uint32_t meshes[] = {scene.mesh(test::finished(triangle)), scene.mesh(test::quad(1e5f, material))};
  settings.camera.near_m = 0.5f;
  const dvec3 on(0.0, 0.0, 2.4);  // on the camera's axis, a little behind the near plane
  for (const dvec3& leaning : {dvec3(1.0, 0.0, 0.6), dvec3(-0.7, 0.9, 0.5), dvec3(0.2, 1.0, 0.3)}) {
    const dvec3 normal = glm::normalize(leaning);
    const dvec3 u = glm::normalize(glm::cross(dvec3(0.0, 1.0, 0.01), normal));
    const dmat4 place(dvec4(u, 0.0), dvec4(glm::cross(normal, u), 0.0), dvec4(normal, 0.0), dvec4(on, 1.0));
    for (const std::uint32_t mesh : meshes) {
      const Entity sheet = scene.draw(mesh, place);
      const LinearPicture picture = shot();
      std::size_t seen = 0, cut = 0, wrong = 0;
      for (std::uint32_t y = 0; y < settings.height; ++y)
        for (std::uint32_t x = 0; x < settings.width; ++x) {
          const Ray r = ray(x, y);
          const double t = glm::dot(on - r.origin, normal) / glm::dot(r.direction, normal);
          const double depth = -t * r.direction.z;
          if (std::abs(depth / 0.5 - 1.0) < 0.02) continue;  // less than a pixel from the cut
          const bool expected = depth > 0.5;
          (expected ? seen : cut) += 1;
          wrong += (pixel(picture, x, y).r > 0.5) == expected ? 0 : 1;
        }
      EXPECT_EQ(wrong, 0u) << "normal " << leaning.x << ", " << leaning.y;
      EXPECT_GT(seen, 300u);
      EXPECT_GT(cut, 300u);
      world.destroy(sheet);
    }
  }
}

}  // namespace
}  // namespace gloam
