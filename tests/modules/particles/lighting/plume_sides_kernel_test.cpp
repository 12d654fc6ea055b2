// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// The sides of plumes against light that is marched through their particles in double precision. The march knows
// neither the axis of an emitter nor a direction out of a plume: each sprite is a ball that hides what lies behind it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/ext/matrix_transform.hpp>
#include <string>
#include <vector>

#include "engine/core/text/formatted.h"
#include "modules/particles/emitters/kinds.h"
#include "modules/particles/reference/particle_twin.h"
#include "tests/modules/particles/support/emitters.h"
#include "tests/modules/particles/support/light_twin.h"
#include "tests/support/kernel.h"

namespace gloam::test {
namespace {

/// A sprite as a ball.
struct Ball {
  dvec3 at;
  double radius, opacity, age;
  dvec3 outward;  ///< of the frame
  dvec3 off;      ///< from the middle of the particles of about its age
  dvec3 along;    ///< the plume's direction there, unit length
};

/// Share of the light from `to_light` that comes through the other balls.
double marched(const std::vector<Ball>& balls, std::size_t self, const dvec3& to_light, double erosion) {
  double depth = 0.0;
  for (std::size_t j = 0; j < balls.size(); ++j) {
    const dvec3 to = balls[j].at - balls[self].at;
    const double ahead = glm::dot(to, to_light), r = balls[j].radius;
    const double inside = 1.0 - (glm::dot(to, to) - ahead * ahead) / (r * r);
    if (j == self || inside <= 0.0 || ahead <= -r) continue;
    const double body = std::clamp((inside - 0.5 * erosion) / (1.0 - 0.6 * erosion), 0.0, 1.0);
    const double share = std::min(0.5 + 0.5 * ahead / r, 1.0);  // of the ball that lies ahead
    depth -= std::log(1.0 - balls[j].opacity * inside * body * (2.0 - body)) * share;
  }
  return std::exp(-depth);
}

/// Light of both sides of a plume for a far lamp, over many moments: of particles towards the lamp and away from it.
struct Sides {
  double near[2] = {}, far[2] = {}, weights[2] = {};  ///< [0]: of the frame, [1]: marched

  [[nodiscard]] double ratio(int i) const { return near[i] / weights[0] / (far[i] / weights[1]); }
  [[nodiscard]] double all(int i) const { return (near[i] + far[i]) / (weights[0] + weights[1]); }
};

class PlumeSides : public KernelTest {
 protected:
  /// The balls of an emitter at several moments.
  static std::vector<std::vector<Ball>> moments(const ParticleEmitter& values, const dmat4& pose, int count) {
    SimulationRows scene;
    for (int i = 0; i < count; ++i)
      scene.add(placed(values, pose, static_cast<std::uint32_t>(3 * i)), 10000 + std::int64_t{1733} * i);
    const ParticleStates found = value_of(run_particles(KernelLab(device(), gpu_log()), scene));
    std::vector<std::vector<Ball>> all;
    for (const shaders::ParticleEmitterRow& row : scene.rows) {
      std::vector<Ball> balls;
      for (std::uint32_t k = 0; k < row.count; ++k) {
        const TwinParticle twin = twin_particle(row, k);
        const dvec3 n = static_cast<double>(row.forward) * unpacked_outward(found.particles[row.first + k].outward);
        balls.push_back({twin.position, twin.radius_m, twin.opacity, twin.age_s, n, {}, {}});
      }
      const double window = 0.07 * static_cast<double>(values.lifetime_s);
      const auto middle = [&](double age) {
        dvec4 sum(0.0);
        for (const Ball& ball : balls)
          if (std::abs(ball.age - age) <= window) sum += dvec4(ball.at, 1.0);
        return dvec3(sum) / sum.w;
      };
      const double life = static_cast<double>(values.lifetime_s);
      for (Ball& ball : balls) {
        ball.off = ball.at - middle(ball.age);
        ball.along =
            glm::normalize(middle(std::min(ball.age + window, life)) - middle(std::max(ball.age - window, 0.0)));
      }
      all.push_back(std::move(balls));
    }
    return all;
  }
  static Sides sides(const std::vector<std::vector<Ball>>& moments, const dvec3& to_light, bool only_across) {
    const double erosion = static_cast<double>(kind_properties(EmitterKind::smoke).erosion);
    Sides s;
    for (const std::vector<Ball>& balls : moments)
      for (std::size_t i = 0; i < balls.size(); ++i) {
        const Ball& ball = balls[i];
        // Not where the plume bends towards the lamp or away from it: there it has ends for it, not sides.
        if (only_across && std::abs(glm::dot(ball.along, to_light)) > 0.5) continue;
        const double across = glm::dot(ball.off, to_light), weight = ball.opacity * ball.radius * ball.radius;
        const bool is_near = across > 0.0;
        s.weights[is_near ? 0 : 1] += weight;
        auto& side = is_near ? s.near : s.far;
        side[0] += weight * (1.0 + glm::dot(ball.outward, to_light));
        side[1] += weight * marched(balls, i, to_light, erosion);
      }
    return s;
  }
};

struct Plume {
  const char* name;
  ParticleEmitter values;
};

ParticleEmitter smoke(float rate, float lifetime_s, float size_m, float speed, float spread, float box_m) {
  ParticleEmitter values;
  values.kind = EmitterKind::smoke;
  values.rate = rate;
  values.lifetime_s = lifetime_s;
  values.size_m = size_m;
  values.speed = speed;
  values.spread = spread;
  values.box_m = vec3(box_m, 0.2f * box_m, box_m);
  return values;
}

const dvec3 kSix[] = {{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}};

/// A node whose +Y is `up`.
dmat4 pose_along(const dvec3& up) {
  const dvec3 y = glm::normalize(up), other = std::abs(y.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
  const dvec3 x = glm::normalize(glm::cross(other, y));
  return {dvec4(x, 0.0), dvec4(y, 0.0), dvec4(glm::cross(x, y), 0.0), dvec4(0.0, 0.0, 0.0, 1.0)};
}

/// Two directions across a jet.
std::vector<dvec3> across(const dvec3& jet) {
  const dmat4 pose = pose_along(jet);
  return {dvec3(pose[0]), -dvec3(pose[0]), dvec3(pose[2]), -dvec3(pose[2])};
}

void expect_sides(const Sides& s, const std::string& what) {
  EXPECT_GT(std::min(s.weights[0], s.weights[1]), 0.5) << what << ": too few particles lie across the light";
  EXPECT_NEAR(s.ratio(0) / s.ratio(1), 1.0, 0.15)
      << what << ": near : far is " << s.ratio(0) << ", marched " << s.ratio(1);
  ::testing::Test::RecordProperty(what, std::to_string(s.ratio(0) / s.ratio(1)));
}

std::string words(const dvec3& v) { return formatted("(%.1f %.1f %.1f)", v.x, v.y, v.z); }

// Hard case: particles.jets_in_six_directions
TEST_F(PlumeSides, are_lit_as_marched_for_jets_in_six_directions_and_slanted_ones) {
  const Plume plumes[] = {{"jet", smoke(140.0f, 2.0f, 0.3f, 3.0f, 0.16f, 0.3f)},
                          {"thin jet", smoke(30.0f, 2.0f, 0.3f, 3.0f, 0.16f, 0.3f)},
                          {"wide jet", smoke(300.0f, 2.0f, 0.25f, 3.0f, 0.35f, 0.6f)}};
  for (const Plume& plume : plumes) {
    std::vector<dvec3> jets(std::begin(kSix), std::end(kSix));
    jets.push_back(dvec3(0.6, 0.5, -0.7));
    jets.push_back(dvec3(-0.3, -0.6, 0.4));  // not looked at while constants were chosen
    for (const dvec3& jet : jets) {
      const auto balls = moments(plume.values, pose_along(jet), 12);
      for (const dvec3& lamp : across(jet))
        expect_sides(sides(balls, lamp, true), std::string(plume.name) + words(jet) + " lamp " + words(lamp));
    }
  }
}

TEST_F(PlumeSides, are_lit_as_marched_for_smoke_that_bends_upwards) {
  const ParticleEmitter values = smoke(70.0f, 4.0f, 0.3f, 0.9f, 0.16f, 0.3f);
  for (const dvec3& jet : kSix) {
    const auto balls = moments(values, pose_along(jet), 24);
    for (const dvec3& lamp : across(jet))
      if (std::abs(lamp.y) < 0.5) expect_sides(sides(balls, lamp, true), "plume " + words(jet) + words(lamp));
  }
}

/// An outward direction from a vertical column lights one end of lying smoke 3.5 times as much as the other.
TEST_F(PlumeSides, lying_smoke_has_equal_light_from_lamps_at_either_end) {
  for (const dvec3& jet : kSix) {
    const auto balls = moments(smoke(140.0f, 2.0f, 0.3f, 3.0f, 0.16f, 0.3f), pose_along(jet), 12);
    const double one = sides(balls, jet, false).all(0), other = sides(balls, -jet, false).all(0);
    EXPECT_NEAR(one / other, 1.0, 0.05) << words(jet);
  }
}

/// The same smoke in a world of millimetres.
TEST_F(PlumeSides, do_not_depend_on_the_unit_of_the_world) {
  ParticleEmitter metres = smoke(140.0f, 2.0f, 0.3f, 3.0f, 0.16f, 0.3f), small = metres;
  small.metres_per_unit = 1e-3f;
  small.size_m *= 1e3f;
  small.speed *= 1e3f;
  small.box_m *= 1e3f;
  const auto a = moments(metres, pose_along({1, 0, 0}), 2), b = moments(small, pose_along({1, 0, 0}), 2);
  double most = 0.0;
  for (std::size_t m = 0; m < a.size(); ++m)
    for (std::size_t i = 0; i < a[m].size(); ++i) {
      EXPECT_LT(glm::length(a[m][i].outward - b[m][i].outward), 0.01) << i;
      most = std::max(most, glm::length(a[m][i].outward));
    }
  EXPECT_GT(most, 0.3);
}

}  // namespace
}  // namespace gloam::test
