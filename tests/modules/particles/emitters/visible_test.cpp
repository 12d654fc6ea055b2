// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/visible.h"

#include <gtest/gtest.h>

#include "modules/particles/reference/particle_twin.h"
#include "tests/modules/particles/support/emitters.h"
#include "tests/support/render_scene.h"

namespace gloam::test {
namespace {

RenderView view_of(const dvec3& eye, const dvec3& target) { return make_view(look_at(eye, target, 320, 180), 0); }

TEST(VisibleEmitters, hold_every_emitter_with_a_sprite_in_view_and_its_depths) {
  std::mt19937 random(9);
  int seen = 0;
  for (int i = 0; i < 200; ++i) {
    const PlacedEmitter emitter = placed(any_emitter(random, kAllKinds[i % 4]), any_pose(random));
    const RenderView view = view_of(dvec3(0.0, 1.0, 6.0), dvec3(0.0));
    const VisibleEmitters found = find_visible_emitters({&emitter, 1}, view, 100);
    const shaders::ParticleEmitterRow row = row_at(emitter, 100, view.position);
    EXPECT_EQ(found.alive, row.count);
    for (std::uint32_t k = 0; k < row.count; ++k) {
      const TwinParticle p = twin_particle(row, k);
      const dvec4 clip = glm::dmat4(view.clip_from_relative) * dvec4(p.position, 1.0);
      if (clip.w < static_cast<double>(view.near_m) || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) continue;
      ASSERT_EQ(found.emitters.size(), 1u);
      EXPECT_LE(found.emitters[0].near_m, clip.w);
      EXPECT_GE(found.emitters[0].far_m, clip.w);
      ++seen;
    }
  }
  EXPECT_GT(seen, 1000);
}

TEST(VisibleEmitters, leave_out_emitters_behind_the_camera_and_beside_the_view) {
  ParticleEmitter values;
  values.kind = EmitterKind::smoke;
  const PlacedEmitter emitter = placed(values);
  EXPECT_EQ(find_visible_emitters({&emitter, 1}, view_of({0.0, 0.0, 30.0}, {0.0, 0.0, 0.0}), 0).emitters.size(), 1u);
  const VisibleEmitters behind = find_visible_emitters({&emitter, 1}, view_of({0.0, 0.0, 30.0}, {0.0, 0.0, 60.0}), 0);
  EXPECT_TRUE(behind.emitters.empty());
  EXPECT_EQ(behind.particles, 0u);
  EXPECT_GT(behind.alive, 0u);
  EXPECT_TRUE(find_visible_emitters({&emitter, 1}, view_of({0.0, 0.0, 30.0}, {60.0, 0.0, 30.0}), 0).emitters.empty());
}

// Hard case: particles.camera_inside
TEST(VisibleEmitters, around_the_camera_have_depths_from_the_near_plane) {
  ParticleEmitter values;
  values.kind = EmitterKind::fog;
  const PlacedEmitter emitter = placed(values);
  const RenderView view = view_of({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
  const VisibleEmitters found = find_visible_emitters({&emitter, 1}, view, 0);
  ASSERT_EQ(found.emitters.size(), 1u);
  EXPECT_EQ(found.emitters[0].near_m, static_cast<double>(view.near_m));
}

TEST(VisibleEmitters, sprites_of_no_size_are_alive_but_not_in_view) {
  ParticleEmitter values;
  values.kind = EmitterKind::dust;
  values.size_m = 0.0f;
  const PlacedEmitter emitter = placed(values);
  const VisibleEmitters found = find_visible_emitters({&emitter, 1}, view_of({0.0, 0.0, 5.0}, {}), 0);
  EXPECT_TRUE(found.emitters.empty());
  EXPECT_EQ(found.alive, 40u);
}

TEST(VisibleEmitters, too_many_keep_the_nearest) {
  ParticleEmitter values;
  values.kind = EmitterKind::dust;
  values.size_m = 0.01f;
  values.lifetime_s = 0.1f;
  values.rate = 10.0f;
  std::vector<PlacedEmitter> emitters(kMostVisibleEmitters + 10, placed(values));
  for (std::size_t i = 0; i < 10; ++i) emitters[100 * i] = placed(values, glm::translate(dmat4(1.0), dvec3(0, 0, -50)));
  const VisibleEmitters found = find_visible_emitters(emitters, view_of({0.0, 0.0, 5.0}, {}), 0);
  EXPECT_EQ(found.left_out, 10u);
  EXPECT_EQ(found.emitters.size(), kMostVisibleEmitters);
  for (std::size_t i = 1; i < found.emitters.size(); ++i)
    ASSERT_LT(found.emitters[i - 1].emitter, found.emitters[i].emitter);
  for (const VisibleEmitter& one : found.emitters) ASSERT_LT(one.far_m, 20.0);
}

}  // namespace
}  // namespace gloam::test
