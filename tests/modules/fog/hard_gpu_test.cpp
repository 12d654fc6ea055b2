// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "engine/render/camera/light_scale.h"
#include "tests/modules/fog/support/fog_stage.h"

namespace gloam::test {
namespace {

/// Distances here follow from the scene, not from the depth image.
class FogHard : public FogStageTest {
 protected:
  /// Lengths of the rays to a wall across the whole view.
  static std::vector<double> wall_distances(const ViewSettings& view, double depth_m) {
    std::vector<double> lengths;
    const double slope = std::tan(0.5 * static_cast<double>(view.camera.fov_y));
    for (std::uint32_t y = 0; y < view.height; ++y)
      for (std::uint32_t x = 0; x < view.width; ++x) {
        const double up = (1.0 - (2.0 * y + 1.0) / view.height) * slope;
        const double right = ((2.0 * x + 1.0) / view.width - 1.0) * slope * view.width / view.height;
        lengths.push_back(view.camera.orthographic ? depth_m : depth_m * std::sqrt(1.0 + up * up + right * right));
      }
    return lengths;
  }
  static void expect_wall(FogStage& stage, double depth_m, const Fog& fog) {
    SCOPED_TRACE("wall at " + std::to_string(depth_m) + " m, density " + std::to_string(fog.density));
    const LightMap clear = stage.draw_clear();
    ASSERT_GT(clear.texels.front().r, 0.0);
    ASSERT_GT(clear.texels.back().r, 0.0);
    stage.put(fog);
    stage.set("fog.resolution", "full");
    stage.set("fog.radius", "6");
    const double most_light = kMostLight / static_cast<double>(light_scale(scene_brightness(stage.world)));
    expect_picture(stage.draw(),
                   twin_picture(clear, wall_distances(stage.view, depth_m), fog, 1, 6.0, most_light).light);
  }
  static void expect_sane(FogStage& stage) {
    std::size_t wrong = 0;
    for (const float value : stage.draw().rgba) wrong += value >= 0.0f && std::isfinite(value) ? 0 : 1;
    EXPECT_EQ(wrong, 0u);
  }
};

// Hard case: fog.wide_lens
TEST_F(FogHard, rays_to_the_corners_of_a_wide_lens_are_longer) {
  FogStage stage;
  stage.view.camera.fov_y = 2.4f;
  stage.glow({0.0, 0.0, -4.0}, 1000.0f, vec3(2.0f, 1.0f, 0.5f));
  expect_wall(stage, 4.0, {0.1f, vec3(0.3f)});
}

// Hard case: fog.orthographic
TEST_F(FogHard, orthographic_rays_are_all_as_long_as_the_depth) {
  FogStage stage;
  stage.view.camera.orthographic = true;
  stage.view.camera.half_width_m = 6.0f;
  stage.view.camera.half_height_m = 4.0f;
  stage.glow({0.0, 0.0, -4.0}, 50.0f, vec3(2.0f, 1.0f, 0.5f));
  expect_wall(stage, 4.0, {0.1f, vec3(0.3f)});
  stage.view.camera.far_m = 4000.0f;
  expect_wall(stage, 4.0, {0.1f, vec3(0.3f)});
}

// Hard case: fog.near_planes
TEST_F(FogHard, surfaces_are_as_far_as_they_are_with_near_planes_of_any_distance) {
  for (const float near_m : {1e-9f, 1e-6f, 0.1f, 5.0f}) {
    SCOPED_TRACE(near_m);
    FogStage stage;
    stage.view.camera.near_m = near_m;
    stage.glow({0.0, 0.0, -40.0}, 500.0f, vec3(2.0f, 1.0f, 0.5f));
    expect_wall(stage, 40.0, {0.02f, vec3(0.3f)});
  }
}

// Hard case: fog.far_surfaces
TEST_F(FogHard, far_surfaces_are_as_dim_as_the_sky) {
  for (const double depth_m : {150.0, 199.0, 250.0, 1e5, 1e8}) {
    FogStage stage;
    stage.glow({0.0, 0.0, -depth_m}, static_cast<float>(100.0 * depth_m), vec3(2.0f, 1.0f, 0.5f));
    expect_wall(stage, depth_m, {0.01f, vec3(0.3f)});
  }
  FogStage sky;
  sky.sky(vec3(2.0f, 1.0f, 0.5f));
  expect_wall(sky, std::numeric_limits<double>::infinity(), {0.01f, vec3(0.3f)});
}

// Hard case: fog.densities
TEST_F(FogHard, densities_from_nothing_to_a_wall_before_the_camera) {
  FogStage stage;
  stage.glow({0.0, 0.0, -4.0}, 50.0f, vec3(2.0f, 1.0f, 0.5f));
  for (const float density : {1e-30f, 1e-5f, 1.0f, 30.0f, 1e3f}) expect_wall(stage, 4.0, {density, vec3(0.3f)});
}

// Hard case: fog.colours
TEST_F(FogHard, colours_from_black_to_more_than_the_picture_can_hold) {
  for (const float color : {0.0f, 1e-4f, 65504.0f, 1e6f}) {
    FogStage stage;
    stage.glow({0.0, 0.0, -4.0}, 50.0f, vec3(2.0f, 1.0f, 0.5f));
    expect_wall(stage, 4.0, {0.1f, vec3(color, 0.3f, color)});
  }
}

// Hard case: fog.strong_light
TEST_F(FogHard, light_of_any_strength_stays_light_in_any_fog) {
  for (const float strength : {1e4f, 65504.0f, 1e8f})
    for (const float density : {1e-6f, 0.05f, 1e3f, std::numeric_limits<float>::infinity()})
      for (const float color : {0.0f, 1e6f, std::numeric_limits<float>::max()})
        for (const char* resolution : {"full", "quarter"}) {
          SCOPED_TRACE(std::to_string(strength) + ", " + std::to_string(density) + ", " + std::to_string(color));
          FogStage stage;
          stage.fill();
          stage.glow({0.2, 0.0, -2.0}, 0.3f, vec3(strength));
          stage.set("fog.resolution", resolution);
          stage.put({density, vec3(color)});
          expect_sane(stage);
        }
}

// A dark square before bright surroundings: the glow reaches into it, the length of its rays does not leave it.
// Hard case: fog.depth_edges
TEST_F(FogHard, edges_of_depth_stay_sharp_while_the_glow_is_small) {
  FogStage stage;
  stage.sky(vec3(1.0f));
  stage.glow({0.013, 0.007, -0.5}, 0.06f, vec3(0.0f));
  const LightMap clear = stage.draw_clear();
  const std::vector<double> distances = stage.distances();
  const Fog fog{0.05f, vec3(0.0f)};
  stage.put(fog);
  for (const char* resolution : {"full", "half", "quarter"}) {
    stage.set("fog.resolution", resolution);
    const LinearPicture drawn = stage.draw();
    std::size_t dark = 0;
    for (std::size_t i = 0; i < distances.size(); ++i) {
      if (std::isinf(distances[i])) continue;
      // At most the glow of a white picture, half of which is seen, on the square's own short path.
      const double kept = std::exp(-0.05 * distances[i]);
      const double most = kept * clear.texels[i].r + 0.5 * (1.0 - kept);
      ASSERT_LE(static_cast<double>(drawn.rgba[4 * i]), most * (1.0 + kDrawnSteps)) << resolution << " " << i;
      ++dark;
    }
    EXPECT_GT(dark, 50u);
  }
}

// A bright square near the camera, before a far dark wall: fog scatters little of the square's light on its short way,
// so the wall beside it has no bright rim.
// Hard case: fog.rim
TEST_F(FogHard, near_bright_things_have_no_rim_before_a_far_wall) {
  FogStage stage;
  stage.glow({0.013, 0.007, -0.5}, 0.06f, vec3(4.0f, 2.0f, 1.0f));
  stage.glow({0.0, 0.0, -50.0}, 100.0f, vec3(0.01f));
  const LightMap clear = stage.draw_clear();
  const std::vector<double> distances = stage.distances();
  const Fog fog{0.05f, vec3(0.0f)};
  const std::vector<dvec3> exact = oracle_picture(clear, distances, fog);
  stage.put(fog);
  for (const char* resolution : {"full", "half", "quarter"}) {
    stage.set("fog.resolution", resolution);
    const LinearPicture drawn = stage.draw();
    double most = 0.0, most_exact = 0.0;
    for (std::size_t i = 0; i < distances.size(); ++i) {
      if (distances[i] < 10.0) continue;
      most = std::max(most, static_cast<double>(drawn.rgba[4 * i]));
      most_exact = std::max(most_exact, exact[i].r);
    }
    // The square loses 1 − exp(−0.05 · 0.5) of its light, of which half glows, and half of that beside its edge.
    EXPECT_LT(most, 4.0 * 0.0247 * 0.5 * 0.6 + 0.01) << resolution;
    EXPECT_GT(most, 0.5 * most_exact) << resolution;
  }
}

// The mirrored camera stands as far behind the mirror as the camera before it, so its rays are as long as those that
// the mirror sends back.
// Hard case: fog.mirrored
TEST_F(FogHard, mirrored_views_have_the_fog_of_the_whole_way) {
  FogStage stage;
  Material lit{.base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f), .metallic = 0.0f, .roughness = 1.0f};
  lit.emissive = vec3(2.0f, 1.0f, 0.5f);
  lit.double_sided = true;
  stage.scene.draw(stage.scene.mesh(quad(200.0f, stage.scene.material(lit))),
                   glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 3.0)));  // behind the camera
  stage.view.mirror = MirrorPlane{.normal = dvec3(0.0, 0.0, 1.0), .offset = -5.0};
  expect_wall(stage, 5.0 + 8.0, {0.1f, vec3(0.3f)});
}

// See FrontDepth (modules/lighting/outputs.h): reciprocal distances are averaged by opacity.
// Hard case: fog.blended
TEST_F(FogHard, blended_surfaces_count_by_their_opacity) {
  for (const double alpha : {0.0, 0.25, 0.75, 0.999}) {
    SCOPED_TRACE(alpha);
    FogStage stage;
    stage.glow({0.0, 0.0, -20.0}, 50.0f, vec3(2.0f, 1.0f, 0.5f));
    stage.glow({0.0, 0.0, -2.0}, 50.0f, vec3(0.0f, 0.0f, 4.0f), static_cast<float>(alpha));
    expect_wall(stage, 1.0 / (alpha / 2.0 + (1.0 - alpha) / 20.0), {0.05f, vec3(0.3f)});
  }
}

// Hard case: fog.far_from_origin
TEST_F(FogHard, a_camera_far_from_the_origin_has_the_same_fog) {
  FogStage stage;
  const dvec3 far(4e6, -3e6, 5e6);
  stage.view.world_from_camera = glm::translate(dmat4(1.0), far);
  stage.glow(far + dvec3(0.0, 0.0, -4.0), 50.0f, vec3(2.0f, 1.0f, 0.5f));
  expect_wall(stage, 4.0, {0.1f, vec3(0.3f)});
}

}  // namespace
}  // namespace gloam::test
