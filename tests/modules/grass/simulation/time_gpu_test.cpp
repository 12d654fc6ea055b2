// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "tests/modules/grass/support/grass_stage.h"
#include "tests/support/knob_text.h"

namespace gloam::test {
namespace {

constexpr double kStep_s = 1.0 / 60.0;

/// Grass in wind, with a ball that rolls through it.
class GrassTime : public GrassTest {
 protected:
  struct Shown {
    LiveKnots knots;
    std::vector<float> light;
    bool operator==(const Shown&) const = default;
  };

  static Entity begin(GrassStage& stage) {
    stage.lawn(0.6f, 500);
    stage.wind(vec3(4.0f, 0.0f, 1.0f), 0.7f);
    stage.run_at(kStep_s);
    return stage.world.create(Collider{ColliderShape::sphere, 0.12f, 1.8f, vec3(1.0f)}, WorldTransform{});
  }
  /// Draws frame `index`: its time and the ball's place.
  static Shown show(GrassStage& stage, Entity ball, int index) {
    const double time_s = 3.0 + kStep_s * index;
    stage.world.get<WorldTransform>(ball).matrix =
        glm::translate(dmat4(1.0), dvec3(-0.3 + 1.5 * (time_s - 3.0), 0.15, 0.1));
    stage.draw_at(time_s, front());
    return {stage.copy().live_knots(stage.field()), stage.linear().rgba};
  }
};

TEST_F(GrassTime, frames_at_the_time_of_the_last_one_show_the_same) {
  GrassStage stage;
  const Entity ball = begin(stage);
  std::vector<Shown> frames;
  for (int frame = 0; frame < 4; ++frame) frames.push_back(show(stage, ball, frame));
  for (const double dt_s : {kStep_s, 0.0}) {
    stage.run_at(dt_s);
    for (int repeated = 0; repeated < 2; ++repeated) {
      EXPECT_TRUE(show(stage, ball, 3) == frames[3]) << "duration " << dt_s;
      EXPECT_EQ(stage.copy().dispatch.masters, 0u);
    }
  }
  EXPECT_GT(knot_distance(frames[2].knots, frames[3].knots), 0.0);
  EXPECT_GT(differences(frames[2].light, frames[3].light), 100u);
}

// Hard case: further.time_backwards
TEST_F(GrassTime, a_repeated_sequence_of_frames_shows_the_same_each_time) {
  GrassStage stage;
  const Entity ball = begin(stage);
  const int order[] = {0, 0, 1, 2, 3};
  std::vector<Shown> first;
  for (int turn = 0; turn < 3; ++turn)
    for (std::size_t i = 0; i < std::size(order); ++i) {
      const Shown shown = show(stage, ball, order[i]);
      if (turn == 0) first.push_back(shown);
      EXPECT_TRUE(shown == first[i]) << "turn " << turn << ", frame " << i;
    }
  EXPECT_GT(knot_distance(first[0].knots, first[4].knots), 0.0);
}

TEST_F(GrassTime, a_frame_at_the_same_time_does_not_depend_on_the_blades_of_the_last_one) {
  Shown expected;
  {
    GrassStage stage;
    const Entity ball = begin(stage);
    expected = show(stage, ball, 0);
  }
  for (const auto& [knob, other] : {std::pair{"grass.lod_pixels", "8"}, {"grass.masters", "1:16"}}) {
    GrassStage stage;
    const Entity ball = begin(stage);
    const std::string usual = test::knob_text(stage.renderer->knobs(), knob);
    stage.set(knob, other);
    EXPECT_LT(show(stage, ball, 0).knots.size(), expected.knots.size()) << knob;
    stage.set(knob, usual);
    EXPECT_TRUE(show(stage, ball, 0) == expected) << knob;
  }
}

}  // namespace
}  // namespace gloam::test
