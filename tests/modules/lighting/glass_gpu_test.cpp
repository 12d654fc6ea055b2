// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "tests/modules/lighting/lit_scene.h"

namespace gloam {
namespace {

/// Panes of glass among many lights: they are lit by the lights of their tile mask at their own depth, not at that
/// of the surface behind them.
struct Glass : test::LitSceneTest {
  void SetUp() override {
    LitSceneTest::SetUp();
    if (IsSkipped()) return;
    environment().has_exposure = true;
    settings = test::look_at(dvec3(0.0, 1.5, 8.0), dvec3(0.0, 1.0, -4.0), 150, 91);
  }

  void pane(const dvec3& at, double turn = 0.0, float half = 0.8f) {
    Material glass = exact_material(60, 180, 120, 100, 0);
    glass.alpha_mode = AlphaMode::blend;
    glass.base_color.a = 0.4f;
    scene.draw(scene.mesh(test::quad(half, scene.material(glass))),
               glm::rotate(glm::translate(dmat4(1.0), at), turn, dvec3(0.0, 1.0, 0.0)));
  }
  void floor_and_wall() {
    const std::uint32_t stone = scene.material(exact_material(180, 170, 160, 128, 0));
    scene.draw(scene.mesh(test::quad(12.0f, stone)),
               glm::rotate(dmat4(1.0), glm::radians(-90.0), dvec3(1.0, 0.0, 0.0)));
    scene.draw(scene.mesh(test::quad(2.0f, stone)), glm::translate(dmat4(1.0), dvec3(-3.0, 1.0, -6.0)));
  }
  void lamps(std::size_t count, double nearest_z, double farthest_z, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (std::size_t i = 0; i < count; ++i) {
      Light lamp;
      lamp.intensity = 0.5f + static_cast<float>(unit(random));
      lamp.color = vec3(0.3f) + 0.7f * vec3(unit(random), unit(random), unit(random));
      lamp.range_m = 0.4f + static_cast<float>(unit(random));
      if (i % 3 == 0) {
        lamp.kind = LightKind::spot;
        lamp.outer_angle = 0.3f + static_cast<float>(unit(random));
      }
      light(lamp,
            dvec3(10.0 * unit(random) - 5.0, 3.0 * unit(random), nearest_z + (farthest_z - nearest_z) * unit(random)),
            dvec3(unit(random) - 0.5, -0.5, unit(random) - 0.5));
    }
  }

  [[nodiscard]] LinearPicture drawn(const char* culling) {
    EXPECT_TRUE(renderer->knobs().set("lights.culling", culling).ok());
    draw();
    return HasFatalFailure() ? LinearPicture{} : linear();
  }
  void expect_tiled_is_brute(const char* what) {
    const LinearPicture tiled = drawn("tiled");
    const LinearPicture brute = drawn("brute");
    ASSERT_EQ(tiled.rgba.size(), brute.rgba.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < tiled.rgba.size(); ++i) different += tiled.rgba[i] != brute.rgba[i] ? 1 : 0;
    EXPECT_EQ(different, 0u) << what << ", of " << tiled.rgba.size();
  }
};

TEST_F(Glass, before_all_lights_sees_those_that_reach_it) {
  floor_and_wall();
  lamps(150, 2.0, -6.0, 1);
  pane(dvec3(0.5, 1.2, 3.0), 0.2);
  expect_tiled_is_brute("before");
}

TEST_F(Glass, behind_all_lights_sees_those_that_reach_it) {
  floor_and_wall();
  lamps(150, 4.0, -4.5, 2);
  for (const double x : {-2.0, 0.0, 2.0}) pane(dvec3(x, 1.0, -5.0));
  expect_tiled_is_brute("behind");
}

TEST_F(Glass, between_lights_sees_those_that_reach_it) {
  floor_and_wall();
  lamps(200, 4.0, -6.0, 3);
  for (int i = 0; i < 8; ++i) pane(dvec3(i - 4.0, 0.9, 3.0 - i), 0.4 * i);
  expect_tiled_is_brute("between");
}

TEST_F(Glass, before_the_sky_is_lit_where_no_opaque_tile_has_a_list) {
  lamps(120, 2.0, -2.0, 4);
  pane(dvec3(0.0, 1.0, 0.0), 0.0, 3.0f);
  expect_tiled_is_brute("before the sky");
  const LinearPicture lit = drawn("tiled");
  std::size_t bright = 0;  // the sky is black, so every other pixel is glass lit by lamps
  for (std::size_t i = 0; i < lit.rgba.size(); i += 4) bright += lit.rgba[i] + lit.rgba[i + 1] > 0.0f ? 1 : 0;
  EXPECT_GT(bright, 500u);
}

TEST_F(Glass, that_reaches_from_the_camera_to_the_far_end_sees_the_lights_of_every_depth) {
  floor_and_wall();
  lamps(250, 7.5, -8.0, 5);
  pane(dvec3(0.4, 1.2, 0.0), glm::radians(87.0), 12.0f);  // seen nearly edge-on
  for (const bool orthographic : {false, true}) {
    settings.camera.orthographic = orthographic;
    settings.camera.half_height_m = 3.0f;
    expect_tiled_is_brute(orthographic ? "orthographic" : "perspective");
  }
}

TEST_F(Glass, beyond_the_farthest_opaque_surface_of_frames_before_sees_its_lights) {
  // The zBins end at the farthest surface of earlier frames; then glass and lamps appear far beyond it.
  const std::uint32_t stone = scene.material(exact_material(180, 170, 160, 128, 0));
  scene.draw(scene.mesh(test::quad(1.0f, stone)), glm::translate(dmat4(1.0), dvec3(-1.0, 0.5, 4.0)));
  lamps(100, 5.0, 3.0, 6);
  for (int i = 0; i < 3; ++i) ASSERT_NO_FATAL_FAILURE(draw());
  lamps(100, -20.0, -30.0, 7);
  pane(dvec3(0.0, 1.0, -25.0), 0.3, 6.0f);
  expect_tiled_is_brute("far");
}

}  // namespace
}  // namespace gloam
