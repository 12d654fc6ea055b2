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

}  // namespace
}  // namespace gloam
