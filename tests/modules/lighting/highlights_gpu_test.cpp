// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <utility>
#include <vector>

#include "tests/modules/lighting/lit_scene.h"

namespace gloam {
namespace {

/// Highlights of lamps with a width, against the mean over points of the lamp, and highlights on curved surfaces whose
/// camera moves by parts of a pixel.
/// A sphere with the normals of a sphere, as `sides` by 2·`sides` quads.
Primitive ball(float radius, std::uint32_t sides, std::uint32_t material) {
  Primitive primitive;
  primitive.material = material;
  for (std::uint32_t row = 0; row <= sides; ++row)
    for (std::uint32_t column = 0; column <= 2 * sides; ++column) {
      const float polar = kPi * static_cast<float>(row) / static_cast<float>(sides);
      const float around = kPi * static_cast<float>(column) / static_cast<float>(sides);
      const vec3 n(std::sin(polar) * std::cos(around), std::cos(polar), -std::sin(polar) * std::sin(around));
      primitive.positions.push_back(radius * n);
      primitive.normals.push_back(n);
    }
  for (std::uint32_t row = 0; row < sides; ++row)
    for (std::uint32_t column = 0; column < 2 * sides; ++column) {
      const std::uint32_t a = row * (2 * sides + 1) + column, b = a + 2 * sides + 1;
      for (const std::uint32_t corner : {a, b, b + 1, a, b + 1, a + 1}) primitive.indices.push_back(corner);
    }
  return test::finished(std::move(primitive));
}

/// An upright pole through the origin with the normals of a cylinder.
Primitive pole(float radius, std::uint32_t sides, std::uint32_t material) {
  Primitive primitive;
  primitive.material = material;
  for (std::uint32_t column = 0; column <= sides; ++column) {
    const float around = 2.0f * kPi * static_cast<float>(column) / static_cast<float>(sides);
    const vec3 n(std::cos(around), 0.0f, -std::sin(around));
    for (const float height : {-2.0f, 2.0f}) {
      primitive.positions.push_back(radius * n + vec3(0.0f, height, 0.0f));
      primitive.normals.push_back(n);
    }
  }
  for (std::uint32_t a = 0; a < 2 * sides; a += 2)
    for (const std::uint32_t corner : {a, a + 2, a + 3, a, a + 3, a + 1}) primitive.indices.push_back(corner);
  return test::finished(std::move(primitive));
}

struct Highlights : test::LitSceneTest {
  static constexpr double kWidth = 0.4;

  void SetUp() override {
    LitSceneTest::SetUp();
    if (IsSkipped()) return;
    settings.width = 96;
    settings.height = 64;
  }
  void set(const char* knob, const char* value) { ASSERT_TRUE(renderer->knobs().set(knob, value).ok()) << knob; }
  /// A black metal-like wall at z = 0: white metal, seen from the camera of LitSceneTest.
  Material metal(int roughness) { return exact_material(255, 255, 255, static_cast<std::uint8_t>(roughness), 255); }
  Entity lamp(float width_m, const dvec3& at) {
    Light what;
    what.intensity = 10.0f;
    what.width_m = width_m;
    return light(what, at);
  }
  /// A ball of metal before the camera, and a lamp above it.
  void show_ball(World& fresh, int roughness, float width_m, float candela = 500.0f) {
    test::SceneMaker maker(fresh);
    renderer->prepare_world(fresh);
    maker.draw(maker.mesh(ball(0.8f, 48, maker.material(metal(roughness)))));
    Light what;
    what.intensity = candela;
    what.width_m = width_m;
    fresh.create(what, WorldTransform{glm::translate(dmat4(1.0), dvec3(2.0, 6.0, 9.0))});
    fresh.resource<SceneEnvironment>() = environment();
  }
  /// Red light of each pixel.
  std::vector<double> reds() { return reds_of(world, settings); }
  std::vector<double> reds_of(World& what, const ViewSettings& view) {
    draw(what, view);
    const LinearPicture drawn = linear();
    std::vector<double> list;
    for (std::size_t i = 0; i < drawn.rgba.size(); i += 4) list.push_back(drawn.rgba[i]);
    return list;
  }
  /// The mean over 8×8 smaller pixels, which are drawn without a filter.
  std::vector<double> mean_of_smaller_pixels(World& what) {
    constexpr std::uint32_t kFiner = 8;
    set("lighting.specular_antialiasing", "off");
    ViewSettings fine = settings;
    fine.width *= kFiner;
    fine.height *= kFiner;
    const std::vector<double> small = reds_of(what, fine);
    set("lighting.specular_antialiasing", "on");
    std::vector<double> mean(std::size_t{settings.width} * settings.height, 0.0);
    for (std::uint32_t y = 0; y < fine.height; ++y)
      for (std::uint32_t x = 0; x < fine.width; ++x)
        mean[std::size_t{y / kFiner} * settings.width + x / kFiner] +=
            small[std::size_t{y} * fine.width + x] / (kFiner * kFiner);
    return mean;
  }
  static double sum(const std::vector<double>& list) {
    double total = 0.0;
    for (const double value : list) total += value;
    return total;
  }
  static double most(const std::vector<double>& list) { return *std::max_element(list.begin(), list.end()); }

  /// What a wall shows of a sphere: the oracle's mean over lamps at points of its disc as seen from each pixel.
  std::vector<double> wall_under_disc(const Material& material, const dvec3& at) {
    std::vector<double> expected;
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        const test::OracleSurface surface = plane_surface(ray(x, y), 0.0, material);
        const dvec3 to_lamp = glm::normalize(at - surface.position);
        const dvec3 side = glm::normalize(glm::cross(to_lamp, dvec3(0.3, 0.8, 0.1)));
        const dvec3 up = glm::cross(side, to_lamp);
        double mean = 0.0;
        constexpr int kRings = 16, kSpokes = 24;
        for (int ring = 0; ring < kRings; ++ring)
          for (int spoke = 0; spoke < kSpokes; ++spoke) {
            const double r = 0.5 * kWidth * std::sqrt((ring + 0.5) / kRings);
            const double angle = 2.0 * test::kPiOracle * (spoke + 0.5 * (ring % 2)) / kSpokes;
            std::vector<test::OracleLight> point = {oracle_lights.front()};
            point.front().position = at + r * (std::cos(angle) * side + std::sin(angle) * up);
            mean += test::oracle_shade(surface, point, environment()).r / (kRings * kSpokes);
          }
        expected.push_back(mean);
      }
    return expected;
  }

  struct Bounds {
    double sum;         ///< relative difference of the light of all pixels
    double most;        ///< relative difference of the brightest pixel
    double difference;  ///< sum of the pixels' differences over the light of all pixels
  };
  /// Draws a wall of metal under a lamp of kWidth, and compares it with the oracle.
  void expect_highlight_of_disc(int roughness, const dvec3& at, const Bounds& bounds) {
    SCOPED_TRACE(testing::Message() << "roughness " << roughness);
    World fresh;
    oracle_lights.clear();
    test::SceneMaker maker(fresh);
    renderer->prepare_world(fresh);
    const Material material = metal(roughness);
    maker.draw(maker.mesh(test::quad(50.0f, maker.material(material))));
    Light what;
    what.intensity = 10.0f;
    what.width_m = static_cast<float>(kWidth);
    oracle_lights.push_back({what, at, dvec3(0.0, 0.0, -1.0)});
    fresh.create(what, WorldTransform{glm::translate(dmat4(1.0), at)});
    fresh.resource<SceneEnvironment>() = environment();
    const std::vector<double> shown = reds_of(fresh, settings);
    const std::vector<double> expected = wall_under_disc(material, at);
    EXPECT_NEAR(sum(shown) / sum(expected), 1.0, bounds.sum);
    EXPECT_NEAR(most(shown) / most(expected), 1.0, bounds.most);
    double difference = 0.0;
    for (std::size_t i = 0; i < shown.size(); ++i) difference += std::abs(shown[i] - expected[i]);
    EXPECT_LT(difference / sum(expected), bounds.difference);
    renderer->release_world(fresh);
  }
};

TEST_F(Highlights, of_wide_lamps_have_the_light_and_the_brightness_of_the_lamp_at_every_roughness) {
  for (const int roughness : {64, 90, 128, 180, 255})
    expect_highlight_of_disc(roughness, dvec3(0.1, 0.05, 1.2), {.sum = 0.02, .most = 0.02, .difference = 0.03});
}

TEST_F(Highlights, of_wide_lamps_at_grazing_angles_have_the_shape_of_the_mirrored_lamp) {
  // Lower than that, the lamp's size is not small against its height: its parts have other angles and Fresnel terms.
  const auto look_from = [&](double height, const Bounds& bounds) {
    SCOPED_TRACE(height);
    settings = test::look_at(dvec3(3.0, 0.1, height), dvec3(0.0, 0.0, 0.0), 64, 48);
    for (const int roughness : {26, 64, 90, 128})
      expect_highlight_of_disc(roughness, dvec3(-1.5, 0.05, std::max(0.4, 0.5 * height)), bounds);
  };
  look_from(1.5, {.sum = 0.04, .most = 0.12, .difference = 0.08});
  look_from(0.35, {.sum = 0.15, .most = 0.35, .difference = 0.18});
}

TEST_F(Highlights, of_lamps_without_a_width_do_not_depend_on_the_knob) {
  scene.draw(scene.mesh(test::quad(50.0f, scene.material(metal(64)))));
  lamp(0.0f, dvec3(0.1, 0.05, 1.2));
  const std::vector<double> on = reds();
  set("lights.emitter_highlights", "off");
  EXPECT_EQ(on, reds());
}

TEST_F(Highlights, on_curved_metal_stay_as_bright_when_the_camera_moves_by_parts_of_a_pixel) {
  for (const float width_m : {0.0f, 2.5f})
    for (const int roughness : {0, 26, 51, 90}) {
      SCOPED_TRACE(testing::Message() << "width " << width_m << " roughness " << roughness);
      World fresh;
      show_ball(fresh, roughness, width_m);
      double least = 1e30, greatest = 0.0;
      for (int step = 0; step < 5; ++step) {
        ViewSettings moved = settings;
        const double pixel_m = 0.15 * step * 2.0 * 3.0 * std::tan(0.5 * settings.camera.fov_y) / settings.height;
        moved.world_from_camera = glm::translate(dmat4(1.0), dvec3(pixel_m, 0.0, 3.0));
        const double total = sum(reds_of(fresh, moved));
        least = std::min(least, total);
        greatest = std::max(greatest, total);
      }
      EXPECT_GT(least, 0.0);
      // A highlight of a point on a mirror is narrower than a pixel: a Gaussian sampled once a pixel varies by ±3 %.
      EXPECT_LT(greatest / least, width_m > 0.0f ? 1.035 : 1.07);
      renderer->release_world(fresh);
    }
}

TEST_F(Highlights, on_curved_metal_are_the_mean_of_those_of_smaller_pixels) {
  for (const int roughness : {51, 70, 90}) {
    SCOPED_TRACE(roughness);
    World fresh;
    show_ball(fresh, roughness, 1.0f);
    const std::vector<double> shown = reds_of(fresh, settings), expected = mean_of_smaller_pixels(fresh);
    EXPECT_NEAR(sum(shown) / sum(expected), 1.0, 0.01);
    double difference = 0.0;
    for (std::size_t i = 0; i < shown.size(); ++i) difference += std::abs(shown[i] - expected[i]);
    EXPECT_LT(difference / sum(expected), 0.08);
    renderer->release_world(fresh);
  }
}

TEST_F(Highlights, on_thin_poles_are_not_of_lamps_that_none_of_their_normals_reflects) {
  test::SceneMaker maker(world);
  maker.draw(maker.mesh(pole(0.08f, 24, maker.material(metal(64)))));
  lamp(0.0f, dvec3(1.0, 4.0, 1.0));
  const std::vector<double> expected = mean_of_smaller_pixels(world);
  const double most_shown = most(reds_of(world, settings));
  EXPECT_LT(most_shown, 2.0 * most(expected));
}

TEST_F(Highlights, of_pixels_do_not_change_the_reflection_of_the_surroundings) {
  World fresh;
  show_ball(fresh, 0, 0.0f, 0.0f);
  const std::vector<double> on = reds_of(fresh, settings);
  set("lighting.specular_antialiasing", "off");
  EXPECT_EQ(on, reds_of(fresh, settings));
  renderer->release_world(fresh);
}

}  // namespace
}  // namespace gloam
