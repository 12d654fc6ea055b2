// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "tests/modules/particles/support/particle_stage.h"
#include "tests/support/module_demand.h"

namespace gloam::test {
namespace {

/// Frames of worlds with emitters on a device that records commands.
struct ParticleDemand : ModuleDemand {
  ParticleDemand() : ModuleDemand("particles") { request.settings = look_at(dvec3(0.0, 0.5, 5.0), dvec3(0.0), 64, 48); }
  Entity emit(float rate = 50.0f, float lifetime_s = 2.0f, EmitterKind kind = EmitterKind::smoke) {
    ParticleEmitter values;
    values.kind = kind;
    values.rate = rate;
    values.lifetime_s = lifetime_s;
    return world.create(values, WorldTransform{});
  }
};

TEST_F(ParticleDemand, a_scene_without_an_emitter_has_no_particles_at_all) {
  frames();
  expect_nothing();
}

// Hard case: particles.none, particles.lifetime_0
TEST_F(ParticleDemand, emitters_that_emit_nothing_demand_nothing) {
  emit(0.0f);
  emit(-1.0f);
  emit(std::nanf(""));
  emit(10.0f, 0.0f);
  emit(10.0f, -1.0f);
  emit(10.0f, 1.0f, EmitterKind::none);
  frames();
  expect_nothing();
}

TEST_F(ParticleDemand, an_emitter_in_view_has_systems_passes_pipelines_and_memory) {
  emit();
  frames();
  EXPECT_THAT(passes,
              testing::IsSupersetOf({"particle_simulation", "particle_count", "particle_light", "particle_sprites"}));
  EXPECT_THAT(systems, testing::ElementsAre("particle_emitters", "particle_lights", "particle_view"));
  EXPECT_GT(state.pipelines, 0u);
  EXPECT_GT(state.gpu_bytes, 0u);
}

TEST_F(ParticleDemand, an_emitter_out_of_view_dispatches_and_draws_nothing) {
  emit();
  request.settings = look_at(dvec3(0.0, 0.5, 25.0), dvec3(0.0, 0.5, 60.0), 64, 48);
  frames();
  EXPECT_THAT(passes, testing::IsEmpty());
  EXPECT_EQ(state.gpu_bytes, 0u);
  EXPECT_EQ(state.pipelines, 0u);
}

// Hard case: particles.all_dead
TEST_F(ParticleDemand, an_emitter_whose_particles_are_all_dead_dispatches_nothing) {
  emit(1.0f, 0.25f);
  world.resource<SceneClock>().time_s = 0.5;
  frames(1);
  EXPECT_THAT(passes, testing::IsEmpty());
  world.resource<SceneClock>().time_s = 1.1;
  frames(1);
  EXPECT_THAT(passes, testing::Not(testing::IsEmpty()));
}

TEST_F(ParticleDemand, captures_static_views_and_views_without_the_module_have_no_passes) {
  emit();
  request.settings.static_only = true;
  frames();
  EXPECT_THAT(passes, testing::IsEmpty());
  request.settings.static_only = false;
  request.settings.purpose = ViewPurpose::capture;
  frames();
  EXPECT_THAT(passes, testing::IsEmpty());
  request.settings.purpose = ViewPurpose::main;
  request.settings.without = {"particles"};
  frames();
  EXPECT_THAT(passes, testing::IsEmpty());
  request.settings.without.clear();
  frames();
  EXPECT_THAT(passes, testing::Not(testing::IsEmpty()));
}

TEST_F(ParticleDemand, values_that_are_not_finite_are_counted_and_draw_nothing) {
  const Entity emitter = emit();
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
    world.get<ParticleEmitter>(emitter) = {.kind = EmitterKind::fog, .size_m = bad};
    frames();
    EXPECT_THAT(passes, testing::IsEmpty());
    EXPECT_EQ(world.resource<EmitterSet>().unusable, 1u);
    world.get<ParticleEmitter>(emitter) = {.kind = EmitterKind::fog};
    world.get<WorldTransform>(emitter).matrix[3].x = static_cast<double>(bad);
    frames();
    EXPECT_THAT(passes, testing::IsEmpty());
    world.get<WorldTransform>(emitter) = {};
  }
  frames();
  EXPECT_THAT(passes, testing::Not(testing::IsEmpty()));
}

TEST_F(ParticleDemand, without_light_and_with_light_at_each_pixel_there_is_no_light_pass) {
  emit();
  for (const char* knob : {"particles.light=off", "particles.lighting=pixel"}) {
    ASSERT_TRUE(renderer->knobs().set("particles.light", "on").ok());
    ASSERT_TRUE(renderer->knobs().set_assignment(knob).ok());
    frames();
    EXPECT_THAT(passes, testing::Not(testing::Contains("particle_light"))) << knob;
    EXPECT_THAT(passes, testing::Contains("particle_sprites"));
  }
}

TEST_F(ParticleDemand, few_particles_are_sorted_by_one_digit) {
  emit(100.0f, 2.0f);
  frames();
  EXPECT_THAT(passes, testing::Not(testing::Contains("particle_high_digits")));
  emit(100.0f, 2.0f);
  frames();
  EXPECT_THAT(passes, testing::Contains("particle_high_digits"));
}

TEST_F(ParticleDemand, memory_is_freed_when_emitters_are_gone) {
  const Entity emitter = emit();
  frames();
  EXPECT_GT(state.gpu_bytes, 0u);
  world.destroy(emitter);
  frames(130);
  EXPECT_THAT(passes, testing::IsEmpty());
  EXPECT_EQ(state.gpu_bytes, 0u);
}

}  // namespace
}  // namespace gloam::test
