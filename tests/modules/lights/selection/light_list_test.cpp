// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/selection/light_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <random>

namespace gloam {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Light spot_light(float inner, float outer) {
  Light light;
  light.kind = LightKind::spot;
  light.range_m = 10.0f;
  light.inner_angle = inner;
  light.outer_angle = outer;
  return light;
}

/// The factor of a spot's ramp at an angle (radians) between the light's axis and the point.
double strength_at(const Light& light, double angle) {
  const vec2 ramp = spot_ramp(light);
  const double s = std::clamp(std::cos(angle) * static_cast<double>(ramp.x) + static_cast<double>(ramp.y), 0.0, 1.0);
  return s * s;
}

TEST(EffectiveRange, is_the_range_that_was_set) {
  Light light;
  light.range_m = 3.5f;
  light.intensity = 1e6f;
  EXPECT_EQ(effective_range(light), 3.5f);
}

// Hard case: shadows.without_range
TEST(EffectiveRange, without_a_range_is_where_the_light_falls_to_a_millionth_lux) {
  Light light;
  light.intensity = 4.0f;
  EXPECT_FLOAT_EQ(effective_range(light), 2000.0f);
  light.color = vec3(0.25f, 0.0f, 0.1f);
  EXPECT_FLOAT_EQ(effective_range(light), 1000.0f) << "the brightest channel counts";
  EXPECT_NEAR(light.intensity * light.color.r / (effective_range(light) * effective_range(light)), 1e-6f, 1e-10f);
}

TEST(EffectiveRange, is_a_positive_number_whose_square_is_a_float_for_any_light) {
  for (const float range : {0.0f, -1.0f, 1e-30f, 1e30f, kInfinity, -kInfinity, kNan}) {
    for (const float intensity : {0.0f, -5.0f, 1e-30f, 1e38f, kInfinity, kNan}) {
      Light light;
      light.range_m = range;
      light.intensity = intensity;
      const float effective = effective_range(light);
      EXPECT_GT(effective, 0.0f) << range << " " << intensity;
      EXPECT_TRUE(std::isfinite(effective * effective)) << range << " " << intensity;
      EXPECT_GT(1.0f / (effective * effective), 0.0f) << range << " " << intensity;
    }
  }
}

TEST(PlaceLight, shines_along_the_nodes_minus_z_whatever_its_scale) {
  const dmat4 turned = glm::rotate(dmat4(1.0), glm::radians(-90.0), dvec3(1.0, 0.0, 0.0));  // rotates −Z to −Y
  for (const dvec3 scale : {dvec3(1.0), dvec3(7.0), dvec3(1e-4), dvec3(-2.0, 1.0, 1.0), dvec3(1.0, 1.0, 5.0)}) {
    const dmat4 node = glm::translate(dmat4(1.0), dvec3(1.0, 2.0, 3.0)) * turned * glm::scale(dmat4(1.0), scale);
    const PlacedLight placed = place_light(Entity{3, 1}, spot_light(0.1f, 0.5f), node);
    EXPECT_EQ(placed.position, dvec3(1.0, 2.0, 3.0));
    EXPECT_LT(glm::length(placed.direction - vec3(0.0f, -1.0f, 0.0f)), 1e-6f);
    EXPECT_EQ(placed.entity.index, 3u);
    EXPECT_EQ(placed.light.range_m, 10.0f) << "scale does not change the light";
  }
}

TEST(PlaceLight, gives_a_unit_direction_for_a_node_without_size_or_with_infinity) {
  for (const double scale : {0.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    dmat4 node(1.0);
    node[2] = dvec4(0.0, 0.0, scale, 0.0);
    const PlacedLight placed = place_light(Entity{0, 1}, Light{}, node);
    EXPECT_NEAR(glm::length(placed.direction), 1.0f, 1e-6f) << scale;
  }
}

TEST(LightBounds, of_a_point_light_is_its_range_relative_to_the_origin) {
  PlacedLight placed;
  placed.light.range_m = 4.0f;
  placed.position = dvec3(100000.25, 0.5, -3.0);
  const Sphere bounds = light_bounds(placed, dvec3(100000.0, 0.0, 0.0));
  EXPECT_EQ(bounds.center, vec3(0.25f, 0.5f, -3.0f));
  EXPECT_EQ(bounds.radius, 4.0f);
}

TEST(LightBounds, of_a_spot_holds_every_lit_point_and_is_no_larger_than_the_point_lights) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const double degrees : {0.5, 5.0, 30.0, 44.9, 45.0, 45.1, 60.0, 75.0, 89.0, 90.0}) {
    const double outer = glm::radians(degrees);
    PlacedLight placed;
    placed.light = spot_light(0.0f, std::min(static_cast<float>(outer), kPi * 0.5f));
    placed.position = dvec3(3.0, -2.0, 8.0);
    placed.direction = glm::normalize(vec3(0.3f, -0.8f, 0.2f));
    const Sphere bounds = light_bounds(placed, dvec3(1.0, 1.0, 1.0));
    EXPECT_LE(bounds.radius, 10.0f * 1.00001f) << degrees;
    const dvec3 apex = placed.position - dvec3(1.0);
    const dvec3 axis = glm::normalize(dvec3(placed.direction));
    const dvec3 side = glm::normalize(glm::cross(axis, dvec3(1.0, 0.0, 0.0)));
    const dvec3 up = glm::cross(side, axis);
    for (int i = 0; i < 2000; ++i) {
      // Half of the points are on the rim of the cap, where a bound that is too small would fail.
      const double angle = i % 2 == 0 ? outer : outer * unit(random);
      const double distance = i % 4 < 2 ? 10.0 : 10.0 * unit(random);
      const double turn = 2.0 * 3.14159265358979 * unit(random);
      const dvec3 point =
          apex + distance * (std::cos(angle) * axis + std::sin(angle) * (std::cos(turn) * side + std::sin(turn) * up));
      ASSERT_LE(glm::length(point - dvec3(bounds.center)), static_cast<double>(bounds.radius) * (1.0 + 1e-6))
          << degrees;
    }
  }
}

TEST(LightBounds, of_a_cone_beyond_180_degrees_are_those_of_180_degrees) {
  PlacedLight wide;
  wide.light = spot_light(0.0f, 2.5f);
  PlacedLight half = wide;
  half.light.outer_angle = kPi * 0.5f;
  EXPECT_EQ(light_bounds(wide, dvec3(0.0)).radius, light_bounds(half, dvec3(0.0)).radius);
  EXPECT_EQ(spot_ramp(wide.light), spot_ramp(half.light));
}

TEST(SpotRamp, is_full_inside_the_inner_cone_and_dark_outside_the_outer_one) {
  for (const auto& [inner, outer] :
       {std::pair(0.0f, 0.7f), std::pair(0.2f, 0.4f), std::pair(0.0f, kPi * 0.5f), std::pair(0.4f, 0.5f)}) {
    const Light light = spot_light(inner, outer);
    EXPECT_NEAR(strength_at(light, 0.0), 1.0, 1e-5);
    EXPECT_NEAR(strength_at(light, static_cast<double>(inner) * 0.999), 1.0, 1e-5);
    EXPECT_NEAR(strength_at(light, static_cast<double>(outer) * 1.001), 0.0, 1e-9);
    // KHR_lights_punctual: the square of a ramp that is linear in the cosine.
    const double middle =
        std::acos(0.5 * (std::cos(static_cast<double>(inner)) + std::cos(static_cast<double>(outer))));
    EXPECT_NEAR(strength_at(light, middle), 0.25, 1e-4);
  }
}

TEST(SpotRamp, with_equal_angles_is_steep_and_stays_inside_the_outer_cone) {
  const Light light = spot_light(0.5f, 0.5f);
  EXPECT_NEAR(strength_at(light, 0.501), 0.0, 1e-9);
  EXPECT_NEAR(strength_at(light, 0.49), 1.0, 1e-6);
}

TEST(SpotRamp, of_a_point_light_is_one_everywhere) {
  Light light;
  EXPECT_EQ(spot_ramp(light), vec2(0.0f, 1.0f));
  EXPECT_EQ(strength_at(light, 3.0), 1.0);
}

// Hard case: shadows.cone_0
TEST(SpotRamp, of_a_cone_of_no_angle_is_finite) {
  const vec2 ramp = spot_ramp(spot_light(0.0f, 0.0f));
  EXPECT_TRUE(std::isfinite(ramp.x) && std::isfinite(ramp.y));
  EXPECT_NEAR(strength_at(spot_light(0.0f, 0.0f), 0.01), 0.0, 1e-9);
}

}  // namespace
}  // namespace gloam
