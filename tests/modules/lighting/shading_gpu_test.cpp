// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/modules/lighting/lit_scene.h"

namespace gloam {
namespace {

using test::OracleSurface;

struct Shading : test::LitSceneTest {
  Material material = exact_material(200, 120, 60, 102, 0);

  /// A wall at z = 0 that fills the view.
  void wall() { scene.draw(scene.mesh(test::quad(50.0f, scene.material(material)))); }

  /// Compares the picture with the oracle, pixel by pixel.
  void expect_wall_as_computed(double tolerance = 1e-2) {
    ASSERT_NO_FATAL_FAILURE(draw());
    const LinearPicture drawn = linear();
    std::vector<dvec3> expected;
    double brightest = 0.0;
    for (std::uint32_t y = 0; y < settings.height; ++y) {
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        expected.push_back(test::oracle_shade(plane_surface(ray(x, y), 0.0, material), oracle_lights, environment()));
        brightest = std::max({brightest, expected.back().r, expected.back().g, expected.back().b});
      }
    }
    ASSERT_GT(brightest, 0.0);
    double worst = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const auto x = static_cast<std::uint32_t>(i % settings.width);
      const auto y = static_cast<std::uint32_t>(i / settings.width);
      const double error = relative_error(pixel(drawn, x, y), expected[i], brightest);
      EXPECT_LE(error, tolerance) << x << "," << y << " drawn " << pixel(drawn, x, y).r << ", expected "
                                  << expected[i].r;
      worst = std::max(worst, error);
      if (HasFailure()) return;
    }
    RecordProperty("worst_relative_error", std::to_string(worst));
  }
};

TEST_F(Shading, of_a_point_light_is_the_gltf_brdf) {
  wall();
  Light lamp;
  lamp.intensity = 30.0f;
  lamp.color = vec3(1.0f, 0.8f, 0.5f);
  light(lamp, dvec3(0.5, 0.4, 1.0));
  expect_wall_as_computed();
}

TEST_F(Shading, of_a_point_light_ends_at_its_range) {
  wall();
  Light lamp;
  lamp.intensity = 30.0f;
  lamp.range_m = 1.3f;
  light(lamp, dvec3(0.2, 0.1, 0.8));
  expect_wall_as_computed();
}

TEST_F(Shading, of_a_smooth_metal_is_the_gltf_brdf) {
  material = exact_material(230, 200, 150, 64, 255);
  wall();
  Light lamp;
  lamp.intensity = 10.0f;
  light(lamp, dvec3(-0.3, 0.2, 1.5));
  expect_wall_as_computed();
}

TEST_F(Shading, of_a_half_metal_is_the_gltf_brdf) {
  material = exact_material(90, 200, 150, 153, 128);
  wall();
  Light lamp;
  lamp.intensity = 10.0f;
  light(lamp, dvec3(2.0, 0.2, 0.3));
  expect_wall_as_computed();
}

TEST_F(Shading, of_a_spot_is_the_gltf_brdf_inside_its_cone) {
  wall();
  Light lamp;
  lamp.kind = LightKind::spot;
  lamp.intensity = 50.0f;
  lamp.range_m = 9.0f;
  lamp.inner_angle = 0.2f;
  lamp.outer_angle = 0.5f;
  light(lamp, dvec3(0.5, 0.5, 2.0), dvec3(-0.3, -0.2, -1.0));
  expect_wall_as_computed();
}

// Hard case: shadows.cone_180
TEST_F(Shading, of_a_spot_of_180_degrees_lights_up_to_its_plane) {
  wall();
  Light lamp;
  lamp.kind = LightKind::spot;
  lamp.intensity = 50.0f;
  lamp.outer_angle = kPi / 2.0f;
  light(lamp, dvec3(0.0, 0.0, 0.5), dvec3(-1.0, 0.1, -0.2));
  expect_wall_as_computed();
}

TEST_F(Shading, of_a_directional_light_is_the_gltf_brdf) {
  wall();
  Light sun;
  sun.kind = LightKind::directional;
  sun.intensity = 20.0f;
  sun.color = vec3(0.6f, 0.7f, 1.0f);
  light(sun, dvec3(0.0), dvec3(0.4, -0.5, -1.0));
  expect_wall_as_computed();
}

TEST_F(Shading, adds_lights_of_all_kinds_and_the_sky) {
  wall();
  environment().sky_zenith = vec3(0.4f, 0.6f, 1.2f);
  environment().sky_horizon = vec3(0.9f, 0.5f, 0.3f);
  environment().sky_ground = vec3(0.1f, 0.2f, 0.05f);
  Light lamp;
  lamp.intensity = 5.0f;
  light(lamp, dvec3(0.5, 0.4, 1.0));
  lamp.kind = LightKind::spot;
  light(lamp, dvec3(-0.5, 0.4, 1.0), dvec3(0.3, 0.0, -1.0));
  lamp.kind = LightKind::directional;
  light(lamp, dvec3(0.0), dvec3(0.4, 0.5, -1.0));
  expect_wall_as_computed();
}

TEST_F(Shading, under_an_orthographic_camera_sees_everything_from_one_side) {
  material = exact_material(230, 200, 150, 90, 255);
  settings.camera.orthographic = true;
  settings.camera.half_height_m = 1.5f;
  wall();
  Light sun;
  sun.kind = LightKind::directional;
  sun.intensity = 20.0f;
  light(sun, dvec3(0.0), dvec3(0.3, -0.2, -1.0));
  Light lamp;
  lamp.intensity = 4.0f;
  light(lamp, dvec3(0.5, 0.4, 1.0));
  expect_wall_as_computed();
}

TEST_F(Shading, is_the_same_far_from_the_worlds_origin) {
  const dvec3 far(100000.0, 0.0, 0.0);
  scene.draw(scene.mesh(test::quad(50.0f, scene.material(material))), glm::translate(dmat4(1.0), far));
  settings.world_from_camera[3] += dvec4(far, 0.0);
  Light lamp;
  lamp.intensity = 30.0f;
  light(lamp, far + dvec3(0.5, 0.4, 1.0));
  expect_wall_as_computed();
}

TEST_F(Shading, of_a_world_without_lights_is_sky_and_ambient_light) {
  wall();
  environment().sky_zenith = vec3(0.4f, 0.6f, 1.2f);
  environment().sky_horizon = vec3(0.9f, 0.5f, 0.3f);
  environment().sky_ground = vec3(0.1f, 0.2f, 0.05f);
  expect_wall_as_computed();
}

TEST_F(Shading, fills_pixels_without_a_surface_with_the_sky) {
  environment().sky_zenith = vec3(0.4f, 0.6f, 1.2f);
  environment().sky_horizon = vec3(0.9f, 0.5f, 0.3f);
  environment().sky_ground = vec3(0.1f, 0.2f, 0.05f);
  settings.camera.fov_y = 2.0f;
  light(Light{}, dvec3(0.0));
  for (const bool orthographic : {false, true}) {
    settings.camera.orthographic = orthographic;
    ASSERT_NO_FATAL_FAILURE(draw());
    const LinearPicture drawn = linear();
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x)
        ASSERT_LE(relative_error(pixel(drawn, x, y), test::oracle_sky(environment(), ray(x, y).direction), 1.2), 2e-3)
            << x << "," << y;
  }
}

TEST_F(Shading, lights_blended_surfaces_and_lays_them_over_what_is_behind) {
  material = exact_material(200, 200, 200, 204, 0);
  wall();
  Material glass = exact_material(220, 60, 40, 128, 0);
  glass.alpha_mode = AlphaMode::blend;
  glass.base_color.a = 0.25f;
  scene.draw(scene.mesh(test::quad(0.5f, scene.material(glass))), glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 0.5)));
  Light lamp;
  lamp.intensity = 10.0f;
  light(lamp, dvec3(0.3, 0.6, 2.0));
  Light sun;
  sun.kind = LightKind::directional;
  sun.intensity = 3.0f;
  light(sun, dvec3(0.0), dvec3(0.2, 0.3, -1.0));
  environment().sky_zenith = vec3(0.2f);
  ASSERT_NO_FATAL_FAILURE(draw());
  const LinearPicture drawn = linear();
  std::uint32_t covered = 0;
  for (std::uint32_t y = 0; y < settings.height; ++y) {
    for (std::uint32_t x = 0; x < settings.width; ++x) {
      const OracleSurface front = plane_surface(ray(x, y), 0.5, glass);
      const double reach = std::max(std::abs(front.position.x), std::abs(front.position.y));
      if (std::abs(reach - 0.5) < 0.05) continue;  // at the edge of the light's reach
      dvec3 expected = test::oracle_shade(plane_surface(ray(x, y), 0.0, material), oracle_lights, environment());
      if (reach < 0.5) {
        expected = 0.75 * expected + 0.25 * test::oracle_shade(front, oracle_lights, environment());
        ++covered;
      }
      ASSERT_LE(relative_error(pixel(drawn, x, y), expected, 5.0), 1e-2) << x << "," << y;
    }
  }
  EXPECT_GT(covered, 100u);
}

/// A floor and boxes among lights of all kinds.
void crowd(test::SceneMaker& scene, const std::function<void(const Light&, const dvec3&, const dvec3&)>& add_light) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Material stone;
  stone.base_color = vec4(0.6f, 0.55f, 0.5f, 1.0f);
  stone.metallic = 0.1f;
  stone.roughness = 0.45f;
  const std::uint32_t material = scene.material(stone);
  const dmat4 flat = glm::rotate(dmat4(1.0), glm::radians(-90.0), dvec3(1.0, 0.0, 0.0));
  scene.draw(scene.mesh(test::quad(20.0f, material)), flat);
  const std::uint32_t box = scene.mesh(test::box(vec3(0.4f), material));
  for (int i = 0; i < 25; ++i)
    scene.draw(box, glm::rotate(glm::translate(dmat4(1.0), dvec3(6.0 * unit(random), 0.4, 6.0 * unit(random))),
                                3.0 * unit(random), dvec3(0.0, 1.0, 0.0)));
  for (int i = 0; i < 60; ++i) {
    Light light;
    light.intensity = static_cast<float>(6.0 + 5.0 * unit(random));
    light.color = vec3(dvec3(0.7) + 0.3 * dvec3(unit(random), unit(random), unit(random)));
    light.range_m = i % 5 == 0 ? 0.0f : static_cast<float>(2.5 + 1.5 * unit(random));
    if (i % 3 == 0) {
      light.kind = LightKind::spot;
      light.outer_angle = static_cast<float>(0.8 + 0.7 * unit(random));
      light.inner_angle = i % 2 == 0 ? light.outer_angle : 0.0f;
    }
    if (i == 30) {
      light.kind = LightKind::directional;
      light.intensity = 0.2f;
    }
    add_light(light, dvec3(7.0 * unit(random), 1.2 + unit(random), 7.0 * unit(random)),
              dvec3(unit(random), -0.5, unit(random)));
  }
}

TEST_F(Shading, with_light_lists_is_bit_for_bit_that_of_all_lights) {
  crowd(scene, [&](const Light& l, const dvec3& position, const dvec3& direction) { light(l, position, direction); });
  environment().has_exposure = true;
  for (const bool orthographic : {false, true}) {
    settings = test::look_at(dvec3(5.0, 3.0, 7.0), dvec3(0.0, 0.5, 0.0), 203, 117);
    settings.camera.orthographic = orthographic;
    settings.camera.half_height_m = 4.0f;
    ASSERT_TRUE(renderer->knobs().set("lights.culling", "tiled").ok());
    ASSERT_NO_FATAL_FAILURE(draw());
    const LinearPicture tiled = linear();
    const Picture tiled_picture = picture();
    ASSERT_TRUE(renderer->knobs().set("lights.culling", "brute").ok());
    ASSERT_NO_FATAL_FAILURE(draw());
    const LinearPicture brute = linear();
    ASSERT_EQ(tiled.rgba.size(), brute.rgba.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < tiled.rgba.size(); ++i) different += tiled.rgba[i] != brute.rgba[i] ? 1 : 0;
    EXPECT_EQ(different, 0u) << "of " << tiled.rgba.size() << ", orthographic " << orthographic;
    EXPECT_EQ(tiled_picture.rgba, picture().rgba);
    EXPECT_GT(*std::max_element(tiled.rgba.begin(), tiled.rgba.end()), 1.0f);
  }
}

TEST_F(Shading, gives_the_same_picture_twice) {
  crowd(scene, [&](const Light& l, const dvec3& position, const dvec3& direction) { light(l, position, direction); });
  settings = test::look_at(dvec3(5.0, 3.0, 7.0), dvec3(0.0, 0.5, 0.0), 97, 61);
  ASSERT_NO_FATAL_FAILURE(draw());
  const LinearPicture first = linear();
  ASSERT_NO_FATAL_FAILURE(draw());
  EXPECT_EQ(linear().rgba, first.rgba);
}

TEST_F(Shading, never_gives_nan_or_infinity) {
  material.roughness = 0.0f;
  wall();
  Light lamp;
  lamp.intensity = 1e12f;
  light(lamp, dvec3(0.0, 0.0, 0.01));
  light(lamp, dvec3(0.0, 0.0, 0.0));  // on the surface
  light(lamp, dvec3(0.4, 0.3, 3.0));  // at the camera
  lamp.intensity = 1e38f;
  light(lamp, dvec3(0.1, 0.0, 0.5));
  lamp.kind = LightKind::directional;
  for (const double sign : {1.0, -1.0}) light(lamp, dvec3(0.0), sign * dvec3(0.4, 0.3, 3.0));
  lamp.kind = LightKind::spot;
  lamp.outer_angle = 0.0f;
  light(lamp, dvec3(0.1, 0.0, 0.5));
  Material glass = material;
  glass.alpha_mode = AlphaMode::blend;
  glass.base_color.a = 0.5f;
  scene.draw(scene.mesh(test::quad(0.5f, scene.material(glass))), glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 0.5)));
  ASSERT_NO_FATAL_FAILURE(draw());
  for (const float value : linear().rgba) ASSERT_TRUE(std::isfinite(value) && value >= 0.0f) << value;
}

TEST_F(Shading, of_a_light_straight_behind_a_surface_is_black) {
  // The view looks along −Z at the middle of the wall. There, light and eye are on one line through the surface, so the
  // half vector does not exist.
  settings = test::look_at(dvec3(0.0, 0.0, 3.0), dvec3(0.0), 61, 43);
  wall();
  Light sun;
  sun.kind = LightKind::directional;
  sun.intensity = 100.0f;
  light(sun, dvec3(0.0), dvec3(0.0, 0.0, 1.0));
  Light lamp;
  lamp.intensity = 100.0f;
  light(lamp, dvec3(0.0, 0.0, -1.0));
  ASSERT_NO_FATAL_FAILURE(draw());
  const LinearPicture drawn = linear();
  for (std::uint32_t y = 0; y < settings.height; ++y)
    for (std::uint32_t x = 0; x < settings.width; ++x) ASSERT_EQ(pixel(drawn, x, y), dvec3(0.0)) << x << "," << y;
}

// Hard case: further.size_7x5
TEST_F(Shading, works_at_the_smallest_sizes) {
  wall();
  light(Light{}, dvec3(0.5, 0.4, 1.0));
  for (const uvec2 size : {uvec2(1, 1), uvec2(7, 5), uvec2(33, 31)}) {
    settings.width = size.x;
    settings.height = size.y;
    expect_wall_as_computed();
  }
}

}  // namespace
}  // namespace gloam
