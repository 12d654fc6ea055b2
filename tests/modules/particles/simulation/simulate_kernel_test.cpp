// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "engine/render/camera/view_constants.h"
#include "modules/particles/reference/kernel_checks.h"
#include "modules/particles/reference/particle_twin.h"
#include "modules/particles/simulation/simulate_particles_pass.h"
#include "modules/particles/sorting/key_ranges.h"
#include "shaders/particles/shaders.h"
#include "tests/modules/particles/support/emitters.h"
#include "tests/support/kernel.h"
#include "tests/support/render_scene.h"
#include "tests/support/scale.h"

namespace gloam::test {
namespace {

class ParticleSimulation : public KernelTest {
 protected:
  [[nodiscard]] static ParticleStates simulate(const SimulationRows& rows) {
    return value_of(run_particles(KernelLab(device(), gpu_log()), rows));
  }
};

/// Whether a sprite's sphere certainly shows (1), certainly does not (−1), or rounding decides (0).
int shows(const RenderView& view, const TwinParticle& p, double slack) {
  const double depth = -glm::dot(
      dvec3(view.view_from_relative[0][2], view.view_from_relative[1][2], view.view_from_relative[2][2]), p.position);
  double least = depth - static_cast<double>(view.near_m);
  for (std::size_t i = 0; i < 4; ++i) {
    const Plane& plane = view.frustum.planes[i];
    least =
        std::min(least, glm::dot(dvec3(plane.normal), p.position) + static_cast<double>(plane.distance) + p.radius_m);
  }
  if (p.opacity < 1e-6) return 0;
  return least > slack ? 1 : least < -slack ? -1 : 0;
}

// Hard case: selftest.particles
TEST_F(ParticleSimulation, states_and_keys_are_those_of_the_twin) {
  std::mt19937 random(4);
  SimulationRows scene;
  for (int i = 0; i < scaled(24); ++i)
    scene.add(placed(any_emitter(random, kAllKinds[i % 4]), any_pose(random), static_cast<std::uint32_t>(i)), 1000 * i);
  const ParticleStates found = simulate(scene);
  std::size_t drawn = 0, culled = 0;
  for (const shaders::ParticleEmitterRow& row : scene.rows)
    for (std::uint32_t k = 0; k < row.count; ++k) {
      const shaders::Particle& p = found.particles[row.first + k];
      const TwinParticle twin = twin_particle(row, k);
      // Rounding and the drivers' sines shift a particle, and turbulence enlarges shifts.
      const dvec3 shifted = twin_particle(row, k, dvec3(1e-5)).position;
      const double tolerance = 3e-4 + 40.0 * glm::length(shifted - twin.position);
      EXPECT_LE(glm::length(dvec3(p.position) - twin.position), tolerance) << k << ", age " << twin.age_s;
      EXPECT_NEAR(static_cast<double>(p.radius_m), twin.radius_m, 1e-5 * (1.0 + twin.radius_m));
      EXPECT_NEAR(static_cast<double>(p.life), twin.life, 1e-5);
      EXPECT_LE(static_cast<double>(p.opacity), twin.opacity + 1e-4);
      const std::uint32_t key = found.keys[row.first + k];
      const int expected = shows(scene.view, twin, 2.0 * tolerance);
      if (expected > 0) {
        EXPECT_NE(key, 0xFFFFu) << k;
      } else if (expected < 0) {
        EXPECT_EQ(key, 0xFFFFu) << k;
      }
      if (key == 0xFFFFu) {
        ++culled;
        continue;
      }
      ++drawn;
      const mat4& m = scene.view.view_from_relative;
      const double depth = -glm::dot(dvec3(m[0][2], m[1][2], m[2][2]), dvec3(p.position));
      EXPECT_NEAR(key, (static_cast<double>(row.far_m) - depth) * static_cast<double>(row.keys_per_m), 1.2);
    }
  EXPECT_GT(drawn, 300u);
  EXPECT_GT(culled, 100u);
}

TEST_F(ParticleSimulation, holds_in_the_self_test) { expect_holds(particle_kernel_checks()); }

TEST_F(ParticleSimulation, places_without_a_particle_are_never_drawn) {
  SimulationRows scene;
  ParticleEmitter values;
  values.kind = EmitterKind::fog;
  values.rate = 10.0f;
  values.lifetime_s = 1.0f;
  for (std::uint32_t i = 0; i < 5; ++i) scene.add(placed(values, dmat4(1.0), i), 100);
  const ParticleStates found = simulate(scene);
  for (std::size_t place = 0; place < found.keys.size(); ++place) {
    if (place % GLOAM_PARTICLE_GROUP >= scene.rows[0].count) {
      EXPECT_EQ(found.keys[place], 0xFFFFu) << place;
    }
  }
}

TEST_F(ParticleSimulation, a_particle_does_not_depend_on_its_place_nor_on_the_run) {
  ParticleEmitter values;
  values.kind = EmitterKind::smoke;
  values.rate = 300.0f;
  values.lifetime_s = 3.0f;
  SimulationRows alone, among;
  alone.add(placed(values), 777);
  for (std::uint32_t i = 0; i < 3; ++i) among.add(placed(values, dmat4(1.0), 40 + i), 777);
  among.add(placed(values), 777);
  const ParticleStates a = simulate(alone), again = simulate(alone), b = simulate(among);
  const std::size_t bytes = alone.rows[0].count * sizeof(shaders::Particle);
  EXPECT_EQ(std::memcmp(a.particles.data(), again.particles.data(), bytes), 0);
  for (std::uint32_t k = 0; k < alone.rows[0].count; ++k) {
    shaders::Particle p = b.particles[among.rows[3].first + k];
    p.look &= 0xFFFF0000u;  // the row of the emitter differs
    EXPECT_EQ(std::memcmp(&p, &a.particles[k], sizeof(p)), 0) << k;
  }
}

TEST_F(ParticleSimulation, a_dispatch_of_one_emitter_gives_the_same_particles_to_the_bit) {
  ParticleEmitter values;
  values.kind = EmitterKind::fire;
  values.rate = 900.0f;
  values.lifetime_s = 1.0f;
  SimulationRows scene;
  for (std::uint32_t i = 0; i < 3; ++i) scene.add(placed(values, dmat4(1.0), i), 333);
  const ParticleStates all = simulate(scene);
  Kernel kernel(device(), shaders::particles::simulate_comp, {{"kOneEmitter", 1u}});
  const shaders::ParticleEmitterRow& row = scene.rows[1];
  const std::uint32_t first_group = row.first / GLOAM_PARTICLE_GROUP, groups = (row.count + 63) / 64;
  kernel.push(shaders::ParticleDispatch{first_group, 1});
  kernel.input(0, std::vector{view_constants(scene.view)});
  kernel.input(1, std::vector{scene.frame()});
  kernel.input(2, scene.rows);
  kernel.input(3, scene.groups);
  kernel.input(6, std::vector<shaders::ParticlePose>(1));
  kernel.output(4, all.particles.size() * sizeof(shaders::Particle));
  kernel.output(5, all.keys.size() * sizeof(std::uint32_t));
  kernel.run(groups);
  const auto particles = kernel.read<shaders::Particle>(4);
  const auto keys = kernel.read<std::uint32_t>(5);
  for (std::uint32_t place = 0; place < all.keys.size(); ++place) {
    const bool own = place >= row.first && place < row.first + groups * GLOAM_PARTICLE_GROUP;
    EXPECT_EQ(keys[place], own ? all.keys[place] : Kernel::kUntouched) << place;
    if (own) {
      EXPECT_EQ(std::memcmp(&particles[place], &all.particles[place], sizeof(shaders::Particle)), 0) << place;
    }
  }
}

TEST(SimulationDispatches, cover_all_groups_once_and_give_large_emitters_their_own) {
  std::mt19937 random(8);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::uint32_t> groups;
    for (std::uint32_t row = 0; row < 150; ++row)
      groups.insert(groups.end(), 1 + random() % (row % 3 == 0 ? 40u : 5u), row);
    std::vector<int> covered(groups.size(), 0);
    std::uint32_t own = 0;
    for (const SimulationDispatch& dispatch : simulation_dispatches(groups)) {
      own += dispatch.one_emitter ? 1 : 0;
      for (std::uint32_t i = 0; i < dispatch.groups; ++i) {
        const std::uint32_t group = dispatch.constants.first_group + i;
        ++covered.at(group);
        if (dispatch.one_emitter) {
          EXPECT_EQ(groups[group], dispatch.constants.row);
        }
      }
    }
    EXPECT_GT(own, 20u);
    EXPECT_LE(own, kMostOwnDispatches);
    for (const int times : covered) EXPECT_EQ(times, 1);
  }
  EXPECT_TRUE(simulation_dispatches({}).empty());
}

TEST_F(ParticleSimulation, a_particle_moves_and_fades_without_jumps_from_birth_to_death) {
  ParticleEmitter values;
  values.rate = 20.0f;
  values.lifetime_s = 1.5f;
  for (const EmitterKind kind : kAllKinds) {
    values.kind = kind;
    SimulationRows scene;
    for (std::int64_t step = 0; step < 400; ++step) scene.add(placed(values), step);
    const ParticleStates found = simulate(scene);
    for (std::size_t step = 0; step < 400; ++step) {
      const shaders::ParticleEmitterRow& row = scene.rows[step];
      const shaders::Particle& oldest = found.particles[row.first];
      const shaders::Particle& newest = found.particles[row.first + row.count - 1];
      // A step is 1/360 of the lifetime; births and deaths fall between steps.
      EXPECT_LE(newest.life < 0.003f ? newest.opacity : 0.0f, 0.01f);
      EXPECT_LE(oldest.life > 0.997f ? oldest.opacity : 0.0f, 0.01f);
      if (step == 0) continue;
      const shaders::ParticleEmitterRow& before = scene.rows[step - 1];
      for (std::uint32_t k = 0; k < row.count; ++k) {
        const std::uint32_t earlier = row.oldest + k - before.oldest;
        if (earlier >= before.count) continue;
        const shaders::Particle& p = found.particles[row.first + k];
        const shaders::Particle& q = found.particles[before.first + earlier];
        EXPECT_LE(glm::length(p.position - q.position), 3.0f / 240.0f) << "faster than 3 m/s";
        EXPECT_LE(std::abs(p.opacity - q.opacity), 0.06f);
        EXPECT_EQ(p.look, (q.look & 0xFFFF0000u) | (p.look & 0xFFFFu));
      }
    }
  }
}

// Hard case: particles.behind_near_plane
TEST_F(ParticleSimulation, particles_behind_the_near_plane_and_at_the_camera_are_not_drawn) {
  SimulationRows scene;
  scene.view = make_view(look_at(dvec3(0.0), dvec3(0.0, 0.0, -1.0), 64, 64), 0);
  ParticleEmitter values;
  values.kind = EmitterKind::fog;
  values.rate = 2000.0f;
  values.lifetime_s = 1.0f;
  values.size_m = 3.0f;
  scene.add(placed(values), 55);
  const ParticleStates found = simulate(scene);
  std::size_t drawn = 0;
  for (std::uint32_t k = 0; k < scene.rows[0].count; ++k) {
    if (-found.particles[k].position.z <= scene.view.near_m) {
      EXPECT_EQ(found.keys[k], 0xFFFFu);
    }
    drawn += found.keys[k] != 0xFFFFu ? 1 : 0;
    if (found.keys[k] != 0xFFFFu) {
      const float depth = -found.particles[k].position.z - scene.view.near_m;
      EXPECT_LE(found.particles[k].opacity, 0.06f * depth / std::min(found.particles[k].radius_m, 1e9f) + 1e-4f);
    }
  }
  EXPECT_GT(drawn, 300u);
}

TEST_F(ParticleSimulation, rows_with_nan_and_infinity_draw_nothing) {
  ParticleEmitter values;
  values.kind = EmitterKind::smoke;
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    SimulationRows scene;
    for (int i = 0; i < 4; ++i) scene.add(placed(values), 10);
    scene.rows[0].origin.x = bad;
    scene.rows[1].size_m = bad == bad ? 0.0f : bad;  // an infinite sprite would cover the view
    scene.rows[2].oldest_age_s = bad;
    const ParticleStates found = simulate(scene);
    for (int i = 0; i < 2; ++i)
      for (std::uint32_t k = 0; k < scene.rows[static_cast<std::size_t>(i)].count; ++k)
        EXPECT_EQ(found.keys[scene.rows[static_cast<std::size_t>(i)].first + k], 0xFFFFu) << i;
    std::size_t drawn = 0;
    for (std::uint32_t k = 0; k < scene.rows[3].count; ++k) drawn += found.keys[scene.rows[3].first + k] != 0xFFFFu;
    EXPECT_GT(drawn, 0u) << "other emitters are not affected";
  }
}

}  // namespace
}  // namespace gloam::test
