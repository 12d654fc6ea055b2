// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/births.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace gloam {
namespace {

// Hard case: further.time_negative
TEST(ParticleBirths, all_ages_are_within_the_lifetime_and_no_particle_is_missing) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 20000; ++i) {
    const double lifetime = std::pow(10.0, -3.0 + 5.0 * share(random));
    const double rate = std::min(std::pow(10.0, -3.0 + 7.0 * share(random)), 1e6 / lifetime);
    const auto step = static_cast<std::int64_t>((share(random) - 0.3) * 1e7);
    const LiveParticles live = live_particles(rate, lifetime, step);
    const double time = static_cast<double>(step) / kParticleStepsPerSecond;
    const double slack = 1e-9 * (std::abs(time) + 1.0);
    const auto age = [&](std::int64_t number) { return time - static_cast<double>(number) / rate; };
    EXPECT_NEAR(live.oldest_age_s, age(live.oldest), slack);
    if (live.count > 0) {
      EXPECT_LT(age(live.oldest), lifetime);
      EXPECT_GE(age(live.oldest + live.count - 1), -slack);
    }
    EXPECT_LT(age(live.oldest + live.count), slack) << "the next one is not born yet";
    EXPECT_GE(age(live.oldest - 1), lifetime - slack) << "the one before is dead";
  }
}

TEST(ParticleBirths, a_particle_keeps_its_number_while_it_lives) {
  const double rate = 37.0, lifetime = 1.3;
  for (std::int64_t step = -500; step < 500; ++step) {
    const LiveParticles now = live_particles(rate, lifetime, step), next = live_particles(rate, lifetime, step + 1);
    EXPECT_GE(next.oldest, now.oldest);
    EXPECT_LE(next.oldest, now.oldest + 1);
    const double older = next.oldest_age_s + static_cast<double>(next.oldest - now.oldest) / rate - now.oldest_age_s;
    EXPECT_NEAR(older, 1.0 / kParticleStepsPerSecond, 1e-12);
  }
}

TEST(ParticleBirths, a_slow_emitter_has_times_without_a_particle) {
  EXPECT_EQ(live_particles(1.0, 0.25, 0).count, 1u);
  EXPECT_EQ(live_particles(1.0, 0.25, 120).count, 0u);
}

TEST(ParticleBirths, steps_do_not_depend_on_how_frames_add_up) {
  for (const double dt : {1.0 / 240.0, 1.0 / 120.0, 1.0 / 60.0, 1.0 / 30.0, 1.0 / 24.0}) {
    double time = 0.0;
    while (time < 100.0 - 0.5 * dt) time += dt;
    EXPECT_EQ(particle_step(time), 24000) << dt;
  }
  EXPECT_EQ(particle_step(-1.0 / 240.0), -1);
}

// Hard case: further.thirty_days
TEST(ParticleBirths, after_thirty_days_are_those_of_whole_numbers) {
  // At 30 a second, particle n is born at step 8n, and lives for 600 steps: all ages are fractions of whole numbers.
  const std::int64_t days_30 = std::int64_t{30} * 86400 * 240;
  for (std::int64_t step = days_30 - 20; step <= days_30 + 20; ++step) {
    const LiveParticles live = live_particles(30.0, 2.5, step);
    const std::int64_t youngest = step / 8;
    EXPECT_EQ(live.oldest, youngest - 74) << step;
    EXPECT_EQ(live.count, 75u) << step;
    EXPECT_NEAR(live.oldest_age_s, static_cast<double>(step - 8 * live.oldest) / 240.0, 1e-9) << step;
  }
  EXPECT_EQ(particle_step(30.0 * 86400.0), days_30);
}

TEST(ParticleBirths, times_that_are_not_finite_are_contained) {
  EXPECT_EQ(particle_step(std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_EQ(particle_step(std::numeric_limits<double>::infinity()), 0);
  EXPECT_GT(particle_step(1e300), 0);
}

}  // namespace
}  // namespace gloam
