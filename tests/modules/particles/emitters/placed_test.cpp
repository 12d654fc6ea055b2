// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/placed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "modules/particles/emitters/births.h"
#include "tests/modules/particles/support/emitters.h"

namespace gloam::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();

ParticleEmitter smoke(float rate, float lifetime_s) {
  ParticleEmitter values;
  values.kind = EmitterKind::smoke;
  values.rate = rate;
  values.lifetime_s = lifetime_s;
  return values;
}

// Hard case: particles.lifetime_0
TEST(PlacedEmitters, without_kind_rate_or_lifetime_emit_nothing) {
  EXPECT_TRUE(emits(smoke(1.0f, 1.0f)));
  EXPECT_FALSE(emits(ParticleEmitter{}));
  EXPECT_FALSE(emits(smoke(0.0f, 1.0f)));
  EXPECT_FALSE(emits(smoke(-1.0f, 1.0f)));
  EXPECT_FALSE(emits(smoke(1.0f, 0.0f)));
  EXPECT_FALSE(emits(smoke(1.0f, -2.0f)));
  EXPECT_FALSE(emits(smoke(kNan, 1.0f)));
  EXPECT_FALSE(emits(smoke(1.0f, kNan)));
}

TEST(PlacedEmitters, values_and_matrices_that_are_not_finite_are_refused) {
  PlacedEmitter emitter;
  for (const float bad : {kNan, kInfinite, -kInfinite}) {
    for (float ParticleEmitter::*member :
         {&ParticleEmitter::rate, &ParticleEmitter::lifetime_s, &ParticleEmitter::size_m, &ParticleEmitter::speed,
          &ParticleEmitter::spread}) {
      ParticleEmitter values = smoke(1.0f, 1.0f);
      values.*member = bad;
      EXPECT_FALSE(place_emitter(Entity{1, 1}, values, dmat4(1.0), emitter));
    }
    ParticleEmitter values = smoke(1.0f, 1.0f);
    values.box_m.y = bad;
    EXPECT_FALSE(place_emitter(Entity{1, 1}, values, dmat4(1.0), emitter));
    dmat4 matrix(1.0);
    matrix[3][1] = static_cast<double>(bad);
    EXPECT_FALSE(place_emitter(Entity{1, 1}, smoke(1.0f, 1.0f), matrix, emitter));
    matrix = dmat4(1.0);
    matrix[1][1] = static_cast<double>(bad);
    EXPECT_FALSE(place_emitter(Entity{1, 1}, smoke(1.0f, 1.0f), matrix, emitter));
  }
}

// Hard case: particles.emitter_no_size
TEST(PlacedEmitters, a_node_of_no_size_emits_from_a_point_upward) {
  dmat4 matrix(0.0);
  matrix[3] = dvec4(1.0, 2.0, 3.0, 1.0);
  const PlacedEmitter emitter = placed(smoke(1.0f, 1.0f), matrix);
  EXPECT_EQ(emitter.axis, vec3(0.0f, 1.0f, 0.0f));
  for (const vec3& edge : emitter.box) EXPECT_EQ(edge, vec3(0.0f));
}

TEST(PlacedEmitters, values_beyond_the_ranges_of_the_keys_are_clamped) {
  ParticleEmitter values = smoke(1e30f, 1e30f);
  values.size_m = 1e30f;
  values.speed = -5.0f;
  values.spread = 100.0f;
  values.box_m = vec3(-1.0f, 1e30f, 1.0f);
  const PlacedEmitter emitter = placed(values);
  EXPECT_EQ(emitter.values.rate, 1e6f);
  EXPECT_EQ(emitter.values.lifetime_s, 1e4f);
  EXPECT_EQ(emitter.values.size_m, 1e3f);
  EXPECT_EQ(emitter.values.speed, 0.0f);
  EXPECT_EQ(emitter.values.spread, kPi);
  EXPECT_EQ(emitter.values.box_m, vec3(0.0f, 1e6f, 1.0f));
}

TEST(PlacedEmitters, the_slowest_rate_has_finite_times_between_births) {
  const PlacedEmitter emitter = placed(smoke(1e-40f, 2.0f));
  const shaders::ParticleEmitterRow row = row_at(emitter, 120);
  EXPECT_EQ(row.count, 1u) << "number 0 is born at time 0";
  EXPECT_TRUE(std::isfinite(row.interval_s) && std::isfinite(row.oldest_age_s));
}

// Hard case: particles.million
TEST(PlacedEmitters, a_world_has_at_most_a_million_particles_and_counts_the_rest) {
  std::vector<PlacedEmitter> few = {placed(smoke(100.0f, 2.0f)), placed(smoke(1e5f, 9.0f))};
  EXPECT_EQ(limit_particles(few), 0.0);
  EXPECT_EQ(few[1].rate, 1e5);

  std::vector<PlacedEmitter> many = {placed(smoke(1e6f, 1e4f)), placed(smoke(1e5f, 3.0f)), placed(smoke(7.0f, 1.0f))};
  EXPECT_NEAR(limit_particles(many), 1e10 + 3e5 + 7.0 + 3.0 - 1e6, 1.0);
  for (std::int64_t step = 0; step < 300; ++step) {
    std::uint64_t alive = 0;
    for (const PlacedEmitter& emitter : many)
      alive += live_particles(emitter.rate, static_cast<double>(emitter.values.lifetime_s), step).count;
    EXPECT_LE(alive, 1000000u);
    EXPECT_GT(alive, 999990u);
  }
  EXPECT_NEAR(many[1].rate / many[2].rate, 1e5 / 7.0, 1e-6) << "all are thinned alike";
}

}  // namespace
}  // namespace gloam::test
