// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/flames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "modules/particles/emitters/kinds.h"
#include "modules/particles/reference/particle_twin.h"
#include "tests/modules/particles/support/emitters.h"

namespace gloam::test {
namespace {

ParticleEmitter fire() {
  ParticleEmitter values;
  values.kind = EmitterKind::fire;
  values.rate = 80.0f;
  values.lifetime_s = 0.9f;
  values.size_m = 0.3f;
  values.speed = 0.5f;
  values.spread = 0.3f;
  values.box_m = vec3(0.4f, 0.05f, 0.4f);
  return values;
}

/// Mean over a sprite's disc of its share of opacity, without noise in it: noise of ½ everywhere.
double mean_shape(double erosion) {
  double sum = 0.0;
  constexpr int kRings = 1000;
  for (int i = 0; i < kRings; ++i) {
    const double r2 = (i + 0.5) / kRings, inside = 1.0 - r2;  // rings of equal area
    const double body = std::clamp((inside - 0.5 * erosion) / (1.0 - 0.6 * erosion), 0.0, 1.0);
    sum += inside * body * (2.0 - body) / kRings;
  }
  return sum;
}

TEST(Flames, are_the_fires_among_the_emitters) {
  EXPECT_TRUE(flame_of(Entity{1, 1}, fire()));
  for (const EmitterKind kind : {EmitterKind::none, EmitterKind::smoke, EmitterKind::fog, EmitterKind::dust}) {
    ParticleEmitter other = fire();
    other.kind = kind;
    EXPECT_FALSE(flame_of(Entity{1, 1}, other));
  }
  ParticleEmitter bad = fire();
  bad.size_m = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(flame_of(Entity{1, 1}, bad));
  bad = fire();
  bad.rate = 0.0f;
  EXPECT_FALSE(flame_of(Entity{1, 1}, bad));
}

TEST(Flames, hold_their_sprites_and_have_their_light) {
  const ParticleEmitter values = fire();
  const auto flame = flame_of(Entity{1, 1}, values);
  ASSERT_TRUE(flame);
  const PlacedEmitter emitter = placed(values);
  const KindProperties& kind = kind_properties(EmitterKind::fire);
  double inside = 0.0, all = 0.0;
  constexpr int kSteps = 60;
  for (int step = 0; step < kSteps; ++step) {
    const shaders::ParticleEmitterRow row = row_at(emitter, 97 * step);
    for (std::uint32_t k = 0; k < row.count; ++k) {
      const TwinParticle p = twin_particle(row, k);
      const double cool = p.life * p.life;
      const double light = static_cast<double>(kind.emission.x) * (1.0 + cool * (0.55 - 1.0)) * p.opacity *
                           mean_shape(static_cast<double>(kind.erosion)) * 3.14159265 * p.radius_m * p.radius_m;
      all += light / kSteps;
      const bool contains =
          std::abs(p.position.x) < 0.5 * static_cast<double>(flame->size_m.x) &&
          std::abs(p.position.y - static_cast<double>(flame->middle_m)) < 0.5 * static_cast<double>(flame->size_m.y);
      inside += contains ? light / kSteps : 0.0;
    }
  }
  EXPECT_GT(inside, 0.97 * all);
  constexpr std::uint32_t kSide = 48;
  double shown = 0.0;
  for (const vec4& texel : flame_picture(values, kSide)) {
    EXPECT_TRUE(texel.x >= texel.y && texel.y >= texel.z && texel.z >= 0.0f && texel.w >= 0.0f && texel.w <= 1.0f);
    shown += static_cast<double>(texel.x * flame->size_m.x * flame->size_m.y) / (kSide * kSide);
  }
  // Sprites hide a little of those behind them.
  EXPECT_LT(shown, 1.2 * all);
  EXPECT_GT(shown, 0.6 * all);
}

TEST(Flames, of_an_emitter_that_is_no_fire_have_a_black_picture) {
  for (const vec4& texel : flame_picture({}, 8)) EXPECT_EQ(texel, vec4(0.0f));
}

}  // namespace
}  // namespace gloam::test
