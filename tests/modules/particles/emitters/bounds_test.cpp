// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/bounds.h"

#include <gtest/gtest.h>

#include <cmath>

#include "modules/particles/reference/particle_twin.h"
#include "tests/modules/particles/support/emitters.h"
#include "tests/support/scale.h"

namespace gloam::test {
namespace {

void expect_inside(const PlacedEmitter& emitter, std::int64_t step) {
  const shaders::ParticleEmitterRow row = row_at(emitter, step, emitter.origin);
  for (std::uint32_t k = 0; k < row.count; ++k) {
    const TwinParticle p = twin_particle(row, k);
    EXPECT_LE(2.0 * p.radius_m, static_cast<double>(emitter.largest_m) * (1.0 + 1e-6));
    for (int i = 0; i < 3; ++i) {
      const double at = p.position[i] + emitter.origin[i], reach = std::sqrt(2.0) * p.radius_m;
      EXPECT_GE(at - reach, emitter.bounds.min[i]) << "axis " << i << ", age " << p.age_s;
      EXPECT_LE(at + reach, emitter.bounds.max[i]) << "axis " << i << ", age " << p.age_s;
    }
  }
}

TEST(ParticleBounds, contain_every_sprite_at_every_age) {
  std::mt19937 random(3);
  for (int i = 0; i < scaled(60); ++i)
    for (const EmitterKind kind : kAllKinds) expect_inside(placed(any_emitter(random, kind), any_pose(random)), 77 * i);
}

TEST(ParticleBounds, are_not_much_larger_than_needed) {
  ParticleEmitter values;
  values.kind = EmitterKind::smoke;
  values.lifetime_s = 4.0f;
  values.rate = 500.0f;
  values.box_m = vec3(0.2f);
  const PlacedEmitter emitter = placed(values);
  const shaders::ParticleEmitterRow row = row_at(emitter, 0);
  dvec3 low(1e9), high(-1e9);
  for (std::uint32_t k = 0; k < row.count; ++k) {
    const TwinParticle p = twin_particle(row, k);
    low = glm::min(low, p.position - p.radius_m);
    high = glm::max(high, p.position + p.radius_m);
  }
  const dvec3 found = high - low, bound = emitter.bounds.max - emitter.bounds.min;
  for (int i = 0; i < 3; ++i) EXPECT_LT(bound[i], 3.0 * found[i]) << i;
}

// Hard case: particles.emitter_no_size
TEST(ParticleBounds, of_a_box_without_size_hold_the_sprites) {
  ParticleEmitter values;
  values.kind = EmitterKind::dust;
  values.box_m = vec3(0.0f);
  values.speed = 0.0f;
  const PlacedEmitter emitter = placed(values, glm::translate(dmat4(1.0), dvec3(1e4, 2.0, -3.0)));
  EXPECT_TRUE(emitter.bounds.known());
  expect_inside(emitter, 5);
}

}  // namespace
}  // namespace gloam::test
