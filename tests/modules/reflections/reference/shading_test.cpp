// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/shading.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/modules/lighting/shading_oracle.h"

namespace gloam {
namespace {

/// Random surfaces and directions on their visible side. The oracle is the one that the shaders are tested with.
class ShadingTwin : public testing::Test {
 protected:
  [[nodiscard]] double number(double from, double to) { return std::uniform_real_distribution(from, to)(random_); }
  [[nodiscard]] dvec3 color() { return {number(0.0, 1.0), number(0.0, 1.0), number(0.0, 1.0)}; }
  [[nodiscard]] dvec3 anywhere() {
    for (;;) {
      const dvec3 d(number(-1.0, 1.0), number(-1.0, 1.0), number(-1.0, 1.0));
      if (glm::length(d) < 1.0 && glm::length(d) > 0.1) return glm::normalize(d);
    }
  }
  [[nodiscard]] dvec3 above(const dvec3& normal) {
    for (;;)
      if (const dvec3 d = anywhere(); glm::dot(d, normal) > 0.02) return d;
  }
  [[nodiscard]] test::OracleSurface surface() {
    test::OracleSurface s;
    s.normal = anywhere();
    s.to_eye = above(s.normal);
    s.base_color = color();
    s.metallic = number(0.0, 1.0);
    s.roughness = number(0.2, 1.0);
    return s;
  }
  [[nodiscard]] static TwinPoint twin(const test::OracleSurface& s) {
    return twin_point(s.to_eye, s.normal, s.base_color, s.metallic, s.roughness);
  }
  /// Mean of what points of a lamp give that is seen as a disc of this angular radius.
  [[nodiscard]] static double mean_over_disc(const test::OracleSurface& s, const dvec3& middle, double half_angle) {
    const dvec3 u = glm::normalize(glm::cross(middle, dvec3(0.0, 0.1, 1.0))), v = glm::cross(middle, u);
    constexpr int kPoints = 1500;
    double sum = 0.0;
    for (int i = 0; i < kPoints; ++i) {
      const double radius = std::tan(half_angle) * std::sqrt((i + 0.5) / kPoints), about = 2.399963229728653 * i;
      const dvec3 l = glm::normalize(middle + radius * (std::cos(about) * u + std::sin(about) * v));
      sum += test::oracle_reflected(s, l, dvec3(1.0)).x;
    }
    return sum / kPoints;
  }
  static void expect_equal(const dvec3& actual, const dvec3& expected) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], 1e-9 * (1.0 + std::abs(expected[c])));
  }

  std::mt19937 random_{11};
};

TEST_F(ShadingTwin, reflects_light_as_gltf_defines_it) {
  for (int i = 0; i < 2000; ++i) {
    const test::OracleSurface s = surface();
    const dvec3 to_light = above(s.normal), illuminance = 10.0 * color();
    expect_equal(reflected_light(twin(s), to_light, illuminance), test::oracle_reflected(s, to_light, illuminance));
    expect_equal(reflected_light(twin(s), -above(s.normal), illuminance), dvec3(0.0));
  }
}

TEST_F(ShadingTwin, ambient_light_is_that_of_frames) {
  SceneEnvironment sky;
  for (int i = 0; i < 2000; ++i) {
    sky.sky_zenith = vec3(color());
    sky.sky_horizon = vec3(color());
    sky.sky_ground = vec3(color());
    const test::OracleSurface s = surface();
    const TwinPoint p = twin(s);
    expect_equal(diffuse_ambient(sky, p) + specular_share(p) * mirrored_radiance(sky, p), test::oracle_ambient(s, sky));
    const dvec3 direction = anywhere();
    expect_equal(sky_radiance(sky, direction), test::oracle_sky(sky, direction));
    expect_equal(sky_radiance(sky, -direction), test::oracle_sky(sky, -direction));
  }
}

// The oracle is the mean over points of the lamp. What frames use is a close form (brdf_api.glsl).
TEST_F(ShadingTwin, highlights_are_as_wide_as_their_lights) {
  for (const double roughness : {0.05, 0.1, 0.25, 0.6})
    for (const double half_angle : {0.01, 0.05, 0.15})
      for (const double tilt : {0.2, 0.8}) {
        test::OracleSurface s;
        s.normal = dvec3(0.0, 1.0, 0.0);
        s.to_eye = glm::normalize(dvec3(std::sin(tilt), std::cos(tilt), 0.0));
        s.base_color = dvec3(1.0);
        s.metallic = 1.0;
        s.roughness = roughness;
        double difference = 0.0, all = 0.0;
        // Lights about the mirror direction.
        const double reach = 2.0 * half_angle + 3.0 * roughness * roughness;
        for (int row = -12; row <= 12; ++row)
          for (int column = -12; column <= 12; ++column) {
            const double angle = tilt - reach * row / 12.0, across = reach * column / 12.0;
            if (std::abs(angle) > 1.3) continue;
            const dvec3 middle = glm::normalize(dvec3(-std::sin(angle), std::cos(angle), std::tan(across)));
            const double mean = mean_over_disc(s, middle, half_angle);
            difference += std::abs(reflected_light(twin(s), middle, dvec3(1.0), half_angle).x - mean);
            all += mean;
          }
        EXPECT_LT(difference, 0.15 * all) << roughness << ", " << half_angle << ", " << tilt;
      }
}

}  // namespace
}  // namespace gloam
