// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Particles of emitters that move, against particles that are each born in double precision at the exact pose of the
// emitter at their birth.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/ext/matrix_transform.hpp>
#include <string>

#include "modules/particles/reference/particle_twin.h"
#include "tests/modules/particles/support/emitters.h"
#include "tests/support/kernel.h"

namespace gloam::test {
namespace {

constexpr double kNow = 9.0;
const std::int64_t kNowStep = particle_step(kNow);

ParticleEmitter trail_of(float lifetime_s) {
  ParticleEmitter values;
  values.kind = EmitterKind::smoke;
  values.rate = 400.0f / lifetime_s;
  values.lifetime_s = lifetime_s;
  values.speed = 0.7f;
  values.box_m = vec3(0.5f, 0.1f, 0.3f);
  return values;
}

using Way = std::function<dmat4(double)>;

dmat4 flight(double t) {
  dmat4 m =
      glm::translate(dmat4(1.0), dvec3(1.5 * std::cos(1.3 * t), 0.4 * std::sin(2.0 * t), 1.5 * std::sin(1.3 * t)));
  m = glm::rotate(m, 0.9 * t, glm::normalize(dvec3(0.3, 0.2, 1.0)));
  return glm::scale(m, dvec3(1.0 + 0.4 * std::sin(t), 1.0, 1.0 + 0.3 * std::cos(t)));
}

class ParticleTrail : public KernelTest {
 protected:
  /// Greatest distance of a particle from its exact place. skip_s: births within it of a time in `cuts` do not count.
  static double worst(const ParticleEmitter& values, const Way& way, const EmitterPath& path,
                      const std::vector<double>& cuts = {}, double skip_s = 0.0) {
    PlacedEmitter emitter = placed(values, way(kNow));
    place_path(path, emitter);
    EXPECT_FALSE(emitter.path.empty());
    SimulationRows scene;
    scene.add(emitter, kNowStep);
    const ParticleStates found = value_of(run_particles(KernelLab(device(), gpu_log()), scene));
    double most = 0.0;
    for (std::uint32_t k = 0; k < scene.rows[0].count; ++k) {
      const double age = twin_particle(scene.rows[0], k).age_s;
      bool counts = true;
      for (const double cut : cuts) counts = counts && std::abs(kNow - age - cut) > skip_s;
      if (!counts) continue;
      // The row of an emitter that rests where this particle was born.
      const auto row = row_at(placed(values, way(kNow - age)), kNowStep, scene.view.position);
      const dvec3 exact = twin_particle(row, k).position, at(found.particles[k].position);
      most = std::max(most, std::isfinite(at.x + at.y + at.z) ? glm::length(at - exact) : 1e9);
      const dvec3 world = at + scene.view.position;
      EXPECT_TRUE(glm::all(glm::lessThanEqual(emitter.bounds.min, world)) &&
                  glm::all(glm::lessThanEqual(world, emitter.bounds.max)))
          << k << " is out of the bounds";
    }
    return most;
  }
  static EmitterPath played(const Way& way, double lifetime_s, double hertz) {
    EmitterPath path;
    for (double t = kNow - 2.0 * lifetime_s; t < kNow + 1e-9; t += 1.0 / hertz)
      note_pose(path, t, way(t), false, lifetime_s);
    return path;
  }
};

// Hard case: particles.moving_emitter
TEST_F(ParticleTrail, is_born_where_the_emitter_was) {
  for (const float life : {1.0f, 2.0f, 6.0f}) {
    const ParticleEmitter values = trail_of(life);
    const double life_s = static_cast<double>(life);
    // a · spacing² / 8, with the acceleration of the place, 4 m/s², and that of the corners and directions.
    const auto bound = [&](double spacing) { return 8.0 * spacing * spacing / 8.0 + 1e-3; };
    EXPECT_LT(worst(values, flight, sampled_path(flight, kNow, life_s, 0.05)), bound(2.0 * life_s / kKeptPoses));
    for (const double hertz : {60.0, 24.0})
      EXPECT_LT(worst(values, flight, played(flight, life_s, hertz)), bound(1.0 / hertz + life_s / kKeptPoses))
          << hertz;
  }
  // Without the path the whole plume moves as a block.
  const auto still = [](double) { return flight(kNow); };
  EXPECT_GT(worst(trail_of(2.0f), flight, {{0.0, still(0.0)}, {kNow, still(0.0)}}), 1.0);
}

TEST_F(ParticleTrail, of_a_loop_that_jumps_back_has_no_particle_between) {
  const auto way = [](double t) { return glm::translate(dmat4(1.0), dvec3(2.0 * (t - std::floor(t)), 0.0, 0.0)); };
  const ParticleEmitter values = trail_of(3.0f);
  EXPECT_LT(worst(values, way, sampled_path(way, kNow, 3.0, 0.05), {6.0, 7.0, 8.0, 9.0}, 1e-4), 1e-3);
}

TEST_F(ParticleTrail, of_a_turned_emitter_keeps_the_directions_of_the_births) {
  const auto way = [](double t) { return glm::rotate(dmat4(1.0), 2.0 * t, dvec3(0.0, 0.0, 1.0)); };
  ParticleEmitter values = trail_of(2.0f);
  values.speed = 2.0f;
  EXPECT_LT(worst(values, way, sampled_path(way, kNow, 2.0, 0.05)), 2e-2);
}

TEST_F(ParticleTrail, does_not_change_particles_of_other_emitters) {
  PlacedEmitter moving = placed(trail_of(2.0f), flight(kNow), 4), resting = placed(trail_of(2.0f), flight(1.0), 5);
  place_path(sampled_path(flight, kNow, 2.0, 0.05), moving);
  SimulationRows both, alone;
  both.add(moving, kNowStep);
  both.add(resting, kNowStep);
  alone.add(resting, kNowStep);
  const KernelLab lab(device(), gpu_log());
  const ParticleStates a = value_of(run_particles(lab, both)), b = value_of(run_particles(lab, alone));
  for (std::uint32_t k = 0; k < alone.rows[0].count; ++k)
    EXPECT_EQ(a.particles[both.rows[1].first + k].position, b.particles[k].position) << k;
}

}  // namespace
}  // namespace gloam::test
