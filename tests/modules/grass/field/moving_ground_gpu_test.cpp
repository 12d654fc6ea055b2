// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/ext/quaternion_common.hpp>
#include <vector>

#include "tests/modules/grass/support/grass_stage.h"

// Blades whose ground moves, and those of other lawns beside it.

namespace gloam::test {
namespace {

constexpr double kGroundFrame = 1.0 / 60.0;

class MovingGroundOnGpu : public GrassTest {
 protected:
  /// A camera over both lawns.
  [[nodiscard]] static ViewSettings over() { return look_at({1.2, 2.5, 3.0}, {1.2, 0.1, 0.0}, 96, 64); }
  [[nodiscard]] static dmat4 turned(double angle, const dvec3& axis, const dvec3& at) {
    return glm::rotate(glm::translate(dmat4(1.0), at), angle, axis) * GrassStage::lying(dvec3(0.0));
  }
  static void put(GrassStage& stage, Entity ground, const dmat4& matrix) {
    stage.world.get<WorldTransform>(ground).matrix = matrix;
  }
  /// Knots of the masters of one surface, in the world, in the order of their slots.
  [[nodiscard]] static std::vector<dvec3> knots_of(GrassStage& stage, Entity surface) {
    std::vector<dvec3> found;
    for (const auto& [master, knots] : stage.copy().live_knots(stage.field())) {
      const GrassPatch& patch = stage.field().patches[master / 256];
      if (patch.surface != surface) continue;
      for (const vec4& knot : knots) found.push_back(patch.origin + patch.turn * dvec3(knot));
    }
    return found;
  }
  [[nodiscard]] static double mean_distance(const std::vector<dvec3>& a, const std::vector<dvec3>& b) {
    EXPECT_EQ(a.size(), b.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) sum += glm::length(a[i] - b[i]);
    return sum / static_cast<double>(a.size());
  }
  /// Mean of tip − root over length, in the world.
  [[nodiscard]] static dvec3 mean_lean(GrassStage& stage, Entity surface) {
    const std::vector<dvec3> knots = knots_of(stage, surface);
    dvec3 sum(0.0);
    for (std::size_t i = 0; i + 15 < knots.size(); i += 16) {
      const dvec3 blade = knots[i + 15] - knots[i];
      sum += blade / std::max(glm::length(blade), 1e-6);
    }
    return sum / static_cast<double>(knots.size() / 16);
  }
};

TEST_F(MovingGroundOnGpu, a_lawn_moves_as_if_the_one_beside_it_did_not) {
  GrassStage moving, still;
  Entity own[2], beside[2];
  for (GrassStage* stage : {&moving, &still}) {
    const int i = stage == &still ? 1 : 0;
    own[i] = stage->lawn(0.6f, 300);  // first in the field, so that a new growth would renumber the other
    beside[i] = stage->lawn(0.6f, 400, dvec3(2.4, 0.0, 0.0));
    stage->wind(vec3(8.0f, 0.0f, 0.0f), 0.3f);
    stage->run_at(kGroundFrame);
    stage->draw(over());
  }
  std::vector<dvec3> before = knots_of(moving, beside[0]);
  const std::vector<dvec3> first = before;
  ASSERT_GE(before.size(), 16u * 10u);
  for (int frame = 1; frame <= 40; ++frame) {
    dmat4 pose = turned(0.05 * frame, dvec3(0.0, 1.0, 0.0), dvec3(0.0, 0.01 * frame, 0.0));
    if (frame > 20) pose = glm::scale(pose, dvec3(1.0 + 0.03 * (frame - 20)));  // it is planted anew a few times
    if (frame == 35) moving.world.get<GrassSurface>(own[0]).density *= 3.0f;    // its patches have more masters
    put(moving, own[0], pose);
    moving.draw(over());
    still.draw(over());
    const std::vector<dvec3> now = knots_of(moving, beside[0]);
    ASSERT_EQ(mean_distance(now, knots_of(still, beside[1])), 0.0) << "frame " << frame;
    before = now;
  }
  EXPECT_GT(mean_distance(first, before), 0.01) << "the wind moves it";
}

TEST_F(MovingGroundOnGpu, a_turning_lawn_is_carried_and_keeps_moving) {
  GrassStage stage;
  const Entity ground = stage.lawn(0.6f, 300);
  stage.wind(vec3(8.0f, 0.0f, 0.0f), 0.3f);
  stage.run_at(kGroundFrame);
  stage.draw(over());
  for (int frame = 1; frame <= 30; ++frame) {
    put(stage, ground, turned(0.04 * frame, dvec3(0.0, 1.0, 0.0), dvec3(0.0)));
    stage.draw(over());
  }
  // Knots move relative to the ground, which turns about the origin.
  std::vector<dvec3> knots = knots_of(stage, ground);
  put(stage, ground, turned(0.04 * 31, dvec3(0.0, 1.0, 0.0), dvec3(0.0)));
  stage.draw(over());
  std::vector<dvec3> after = knots_of(stage, ground);
  for (dvec3& knot : after) knot = dvec3(glm::rotate(dmat4(1.0), -0.04, dvec3(0, 1, 0)) * dvec4(knot, 1.0));
  EXPECT_GT(mean_distance(knots, after), 1e-4);
  EXPECT_GT(mean_lean(stage, ground).x, 0.05) << "the wind blows along +x, whatever the ground does";
}

TEST_F(MovingGroundOnGpu, wind_and_gravity_keep_their_directions_on_a_turned_ground) {
  // Planted level and then turned, against planted where it is: the mean lean of many blades is the same.
  const dvec3 axes[] = {dvec3(0.0, 1.0, 0.0), dvec3(0.0, 0.0, 1.0)};
  const double angles[] = {1.6, -0.6};
  for (int i = 0; i < 2; ++i) {
    GrassStage carried, planted;
    for (GrassStage* stage : {&carried, &planted}) {
      const Entity ground = stage->lawn(1.0f, 4000);
      stage->set("grass.masters", "1:1");
      stage->set("grass.lod_pixels", "0");
      stage->wind(vec3(10.0f, 0.0f, 0.0f), 0.0f);
      stage->run_at(1.0 / 30.0);
      const ViewSettings view = look_at({0.0, 3.0, 4.0}, {0.0, 0.0, 0.0}, 96, 64);
      if (stage == &planted) put(*stage, ground, turned(angles[i], axes[i], dvec3(0.0)));
      stage->draw(view);
      put(*stage, ground, turned(angles[i], axes[i], dvec3(0.0)));
      stage->draw(view, 40);
    }
    const Entity ground = carried.field().patches[0].surface;
    const dvec3 a = mean_lean(carried, ground), b = mean_lean(planted, planted.field().patches[0].surface);
    EXPECT_GT(glm::length(b), 0.5);
    EXPECT_LT(glm::length(a - b), 0.02) << "axis " << i << ": " << a.x << " " << a.y << " " << a.z << " against " << b.x
                                        << " " << b.y << " " << b.z;
  }
}

TEST_F(MovingGroundOnGpu, a_ground_that_starts_shakes_its_blades) {
  GrassStage stage;
  const Entity ground = stage.lawn(0.6f, 300);
  stage.run_at(kGroundFrame);
  stage.draw(over(), 30);
  const dvec3 rest = mean_lean(stage, ground);
  for (int frame = 1; frame <= 6; ++frame) {
    const double t = frame * kGroundFrame;
    put(stage, ground, turned(0.0, dvec3(0.0, 1.0, 0.0), dvec3(0.5 * 8.0 * t * t, 0.0, 0.0)));
    stage.draw(over());
  }
  EXPECT_LT(mean_lean(stage, ground).x, rest.x - 0.005);
}

}  // namespace
}  // namespace gloam::test
