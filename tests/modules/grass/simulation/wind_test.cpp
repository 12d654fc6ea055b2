// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/simulation/wind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "engine/math/finite.h"

namespace gloam::test {
namespace {

constexpr double kStep = 1.0 / 120.0;

// Hard case: grass.wind_0
TEST(GrassWind, no_wind_is_still_air) {
  const WindField none = wind_at_step(nullptr, 7, kStep);
  const Wind still{vec3(0.0f), 1.0f};
  const WindField zero = wind_at_step(&still, 7, kStep);
  for (const WindField& wind : {none, zero}) {
    EXPECT_EQ(wind.drift, dvec3(0.0));
    EXPECT_EQ(wind_velocity(wind, dvec3(12.3, 4.0, -77.0)), dvec3(0.0));
  }
}

// Hard case: further.denormals
TEST(GrassWind, nan_and_absurd_velocities_become_finite) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const Wind& wind : {Wind{vec3(kNan, 3.0f, kNan), 0.5f}, Wind{vec3(kInfinity, -kInfinity, 0.0f), kInfinity},
                           Wind{vec3(3e38f), kNan}, Wind{vec3(1e-40f), -4.0f}, Wind{vec3(1000.0f, 0.0f, 0.0f), 1.0f}}) {
    for (const std::uint32_t step : {0u, 1u, 4000000000u, 0xFFFFFFFEu}) {
      const WindField field = wind_at_step(&wind, step, kStep);
      EXPECT_TRUE(is_finite(field.velocity) && is_finite(field.drift));
      EXPECT_LE(glm::length(field.velocity), kGreatestWind * (1.0 + 1e-9));
      EXPECT_TRUE(field.gust >= 0.0 && field.gust <= 1.0);
      for (int i = 0; i < 3; ++i) EXPECT_TRUE(field.drift[i] >= 0.0 && field.drift[i] < GLOAM_GRASS_WIND_PERIOD);
      EXPECT_TRUE(is_finite(wind_velocity(field, dvec3(1.0, 2.0, 3.0))));
    }
  }
  const Wind strong{vec3(1000.0f, 0.0f, 0.0f), 0.0f};
  EXPECT_DOUBLE_EQ(wind_at_step(&strong, 1, kStep).velocity.x, 1000.0) << "1000 m/s is allowed";
}

TEST(GrassWind, repeats_after_its_period_and_is_continuous) {
  const WindField wind{dvec3(5.0, 1.0, -2.0), 1.0, dvec3(17.0, 0.0, 255.9)};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-600.0, 600.0);
  for (int i = 0; i < 2000; ++i) {
    const dvec3 at(place(random), place(random), place(random));
    const dvec3 here = wind_velocity(wind, at);
    EXPECT_LT(glm::length(wind_velocity(wind, at + dvec3(256.0, 0.0, -512.0)) - here), 1e-9);
    EXPECT_LT(glm::length(wind_velocity(wind, at + dvec3(1e-4, 0.0, 1e-4)) - here), 0.01);
    EXPECT_LT(glm::length(wind_velocity(wind, wind_position(at)) - here), 1e-9);
  }
}

TEST(GrassWind, gusts_travel_with_the_wind) {
  const Wind wind{vec3(4.0f, 0.0f, -3.0f), 0.8f};
  const WindField first = wind_at_step(&wind, 1000, kStep);
  const WindField later = wind_at_step(&wind, 1120, kStep);
  const dvec3 at(31.0, 2.0, 77.0);
  EXPECT_LT(glm::length(wind_velocity(first, at) - wind_velocity(later, at + dvec3(4.0, 0.0, -3.0))), 1e-9);
}

// Hard case: further.thirty_days
TEST(GrassWind, gusts_travel_for_thirty_days_as_whole_numbers_say) {
  const Wind wind{vec3(4.5f, 0.0f, -3.25f), 0.8f};
  for (std::uint64_t step = 311040000; step < 311040240; step += 7) {  // 30 days of 1/120 s
    const WindField field = wind_at_step(&wind, static_cast<std::uint32_t>(step), 1.0 / 120.0);
    // Quarters of a metre a second, in whole numbers: the way in 1/480 m, of a period of 256 m.
    const auto way = [&](std::int64_t quarters) {
      const std::int64_t period = 256 * 480, passed = quarters * static_cast<std::int64_t>(step) % period;
      return static_cast<double>(passed < 0 ? passed + period : passed) / 480.0;
    };
    EXPECT_NEAR(field.drift.x, way(18), 1e-6) << step;
    EXPECT_NEAR(field.drift.z, way(-13), 1e-6) << step;
  }
}

TEST(GrassWind, gusts_change_strength_and_direction_with_the_place) {
  const WindField wind{dvec3(5.0, 0.0, 0.0), 0.5, dvec3(0.0)};
  double least = 1e9, most = 0.0, side = 0.0, mean = 0.0;
  constexpr int kPlaces = 64;
  for (int x = 0; x < kPlaces; ++x)
    for (int z = 0; z < kPlaces; ++z) {
      const dvec3 v = wind_velocity(wind, dvec3(4.0 * x, 0.0, 4.0 * z));
      least = std::min(least, v.x);
      most = std::max(most, v.x);
      side = std::max(side, std::abs(v.z));
      mean += v.x / (kPlaces * kPlaces);
    }
  EXPECT_GT(least, 0.0);
  EXPECT_LT(least, 3.5);
  EXPECT_GT(most, 6.5);
  EXPECT_GT(side, 0.7);
  EXPECT_NEAR(mean, 5.0, 0.2) << "gusts keep the mean wind";
}

TEST(GrassWind, position_in_the_field_follows_the_world_and_stays_in_the_period) {
  EXPECT_EQ(wind_position(dvec3(0.0, 300.0, -1.0)), dvec3(0.0, 44.0, 255.0));
  const dvec3 far = wind_position(dvec3(1e5 + 3.25, 0.0, -1e5 - 3.25));
  EXPECT_DOUBLE_EQ(far.x, std::fmod(1e5 + 3.25, 256.0));
  EXPECT_DOUBLE_EQ(far.x + far.z, 256.0);
  EXPECT_EQ(wind_position(dvec3(std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0)), dvec3(0.0, 0.0, 1.0));
}

}  // namespace
}  // namespace gloam::test
