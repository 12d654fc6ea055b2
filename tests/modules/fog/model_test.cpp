// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/fog/model.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "tests/modules/fog/support/fog_oracle.h"

namespace gloam::test {
namespace {

constexpr double kSky = std::numeric_limits<double>::infinity();

/// Random light with a few very bright pixels.
std::vector<float> random_light(std::uint32_t width, std::uint32_t height) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<float> light;
  for (std::uint32_t i = 0; i < width * height; ++i) {
    const float scale = unit(random) < 0.02f ? 1000.0f : 1.0f;
    for (int c = 0; c < 3; ++c) light.push_back(scale * unit(random));
    light.push_back(1.0f);
  }
  return light;
}

void expect_oracle(std::uint32_t width, std::uint32_t height, const Fog& fog) {
  SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height) + ", density " + std::to_string(fog.density));
  const std::vector<float> light = random_light(width, height);
  const double ends[] = {0.0, 1e-6, 0.5, 7.0, 199.0, 201.0, 1e9, kSky};
  std::vector<double> distances;
  for (std::size_t i = 0; i < std::size_t{width} * height; ++i) distances.push_back(ends[i % std::size(ends)]);
  const std::vector<double> fogged = fog_reference(light, distances, width, height, fog);
  const std::vector<dvec3> expected = oracle_picture(light_map(light, width, height), distances, fog);
  ASSERT_EQ(fogged.size(), 4 * expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(fogged[4 * i + static_cast<std::size_t>(c)], expected[i][c], 1e-6 * (1.0 + expected[i][c])) << i;
    ASSERT_EQ(fogged[4 * i + 3], 1.0);
  }
}

TEST(FogModel, equals_the_integral_of_the_light_along_each_ray) {
  for (const float density : {1e-6f, 0.02f, 0.5f, 3.0f}) expect_oracle(40, 30, {density, vec3(0.2f, 3.0f, 0.0f)});
}

TEST(FogModel, equals_the_integral_in_pictures_of_odd_and_least_sizes) {
  for (const auto& [width, height] : {std::pair{1u, 1u}, {1u, 50u}, {61u, 1u}, {37u, 23u}})
    expect_oracle(width, height, {0.05f, vec3(0.5f)});
}

TEST(FogModel, equals_the_integral_with_extreme_colours) {
  for (const float color : {0.0f, 65504.0f, 1e6f}) expect_oracle(9, 7, {0.05f, vec3(color, 1.0f, color)});
}

TEST(FogModel, of_great_density_is_all_that_can_be_seen) {
  const std::vector<float> light = {50.0f, 60.0f, 70.0f, 1.0f};
  const double distance[] = {1.0};
  const std::vector<double> fogged = fog_reference(light, distance, 1, 1, {1e3f, vec3(1.0f, 2.0f, 3.0f)});
  for (std::size_t c = 0; c < 3; ++c)  // one pixel is its own glow, of which half is scattered
    EXPECT_NEAR(fogged[c], static_cast<double>(c + 1) + 0.5 * static_cast<double>(light[c]), 1e-12);
}

TEST(FogModel, the_kernel_ends_at_the_radius_and_covers_the_same_part_of_the_picture_at_any_size) {
  for (const std::uint32_t height : {1u, 71u, 720u, 4320u})
    for (const std::uint32_t divisor : {1u, 2u, 4u})
      for (const float radius : {0.5f, 2.5f, 6.0f}) {
        const GlowKernel kernel = glow_kernel(height, divisor, radius);
        EXPECT_NEAR(static_cast<double>(kernel.sigma), std::max(0.02 * height / divisor, 1e-3), 1e-5 * height);
        EXPECT_GE(static_cast<float>(kernel.taps), radius * kernel.sigma);
        EXPECT_LT(static_cast<float>(kernel.taps), radius * kernel.sigma + 1.0f);
      }
}

TEST(FogModel, finds_the_fog_that_has_a_density) {
  World world;
  world.register_component<Fog>("fog");
  EXPECT_EQ(find_fog(world).density, 0.0f);
  world.create(Fog{0.5f, vec3(1.0f)});
  world.create(Fog{0.0f, vec3(2.0f)});
  world.create(Fog{std::numeric_limits<float>::quiet_NaN(), vec3(3.0f)});
  world.create(Fog{-1.0f, vec3(4.0f)});
  EXPECT_EQ(find_fog(world).color, vec3(1.0f));
}

}  // namespace
}  // namespace gloam::test
