// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/modules/grass/support/simulate_kernel.h"
#include "tests/support/scale.h"

namespace gloam::test {
namespace {

class GrassSimulationHard : public KernelTest {
 protected:
  [[nodiscard]] static GrassInput field(std::uint32_t count, const std::vector<float>& stiffness,
                                        vec3 wind = vec3(0.0f)) {
    GrassInput input;
    for (const float s : stiffness) input.types.push_back(leaning_type(s));
    add_patch(input, count, 9);
    input.steps.wind = {wind, 1.0f, vec3(0.0f)};
    return input;
  }
  [[nodiscard]] static shaders::GrassCollider sphere(vec3 before, vec3 now, float radius_m) {
    shaders::GrassCollider c{};
    c.from_previous = c.to_previous = before;
    c.from = c.to = now;
    c.radius_m = radius_m;
    return c;
  }
  [[nodiscard]] static shaders::GrassCollider box(vec3 at, vec3 half_size) {
    shaders::GrassCollider c{};
    c.from_previous = c.to_previous = c.from = c.to = at;
    c.axis_x = vec3(0.8f, 0.0f, 0.6f);
    c.axis_y = vec3(0.0f, 1.0f, 0.0f);
    c.axis_z = vec3(-0.6f, 0.0f, 0.8f);
    c.half_size = half_size;
    c.box = 1;
    return c;
  }
  /// Runs frames of `steps` steps; all knots must be sound after each, and those of `share` of the blades equal to the
  /// twin's after the first.
  void expect_sound_frames(GrassInput& input, std::uint32_t frames, std::uint32_t steps, double bound_m = 5e-5,
                           double share = 1.0) {
    SimulateTwin twin(input);
    const SimulateKernel kernel(device());
    input.steps.frame_steps = steps;
    for (std::uint32_t f = 0; f < frames; ++f) {
      if (f == 0) twin.advance(input.steps);
      kernel.advance(input, 1);
      if (f == 0) {
        EXPECT_TRUE(std::isfinite(twin.distance(input.knots)));
        EXPECT_GE(share_within(twin, input.knots, bound_m), share);
      }
      expect_sound(twin, input.knots);
      if (HasFailure()) return;
    }
  }
};

// Hard case: grass.segment_no_length
TEST_F(GrassSimulationHard, segments_of_no_length_keep_it) {
  GrassInput input = field(24, {0.1f, 0.5f}, vec3(5.0f, 0.0f, 0.0f));
  for (shaders::GrassTypeRow& type : input.types) {
    type.stem[1] = type.stem[0];
    type.stem[8] = type.stem[7];
    type.stem[9] = type.stem[7];
    type.stem[15] = type.stem[14];
  }
  // Rounding decides the direction of a segment of no length.
  expect_sound_frames(input, 30, 4, 5e-5, 0.9);
}

// Hard case: grass.knots_one_point
TEST_F(GrassSimulationHard, a_type_whose_knots_are_one_point_stays_at_the_root) {
  GrassInput input = field(24, {0.1f, 0.5f}, vec3(50.0f, 0.0f, 0.0f));
  for (shaders::GrassTypeRow& type : input.types)
    for (vec2& knot : type.stem) knot = vec2(0.0f);
  expect_sound_frames(input, 20, 4);
}

// Hard case: grass.knots_one_point
TEST_F(GrassSimulationHard, knots_in_one_point_or_not_finite_find_their_lengths_again) {
  for (const float at : {0.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    SCOPED_TRACE(at);
    GrassInput input = field(24, {0.1f, 0.5f, 0.0f});
    for (shaders::GrassMaster& m : input.masters) m.steps = 1000;
    input.knots.assign(input.knots.size(), vec4(at));
    input.previous = input.knots;
    const SimulateTwin twin(input);
    const SimulateKernel kernel(device());
    for (int frame = 0; frame < 20; ++frame) {
      kernel.advance(input, 1);
      expect_sound(twin, input.knots);
    }
  }
}

// Hard case: grass.wind_1000
TEST_F(GrassSimulationHard, wind_of_a_thousand_metres_a_second_bends_and_breaks_nothing) {
  for (const vec3 wind : {vec3(1000.0f, 0.0f, 0.0f), vec3(0.0f, -1000.0f, 0.0f), vec3(-600.0f, 600.0f, 500.0f)}) {
    GrassInput input = field(32, {0.0f, 0.05f, 0.3f, 1.0f}, wind);
    expect_sound_frames(input, 60, 8);
  }
}

// Hard case: grass.collider_100_m, grass.collider_no_radius, grass.collider_large
TEST_F(GrassSimulationHard, colliders_of_any_kind_leave_the_knots_sound) {
  const std::vector<shaders::GrassCollider> cases = {
      sphere(vec3(-50.0f, 0.1f, 0.0f), vec3(50.0f, 0.1f, 0.0f), 0.5f),       // 100 m in a frame
      sphere(vec3(0.0f), vec3(0.0f), 0.0f),                                  // of no radius
      sphere(vec3(0.0f, -900.0f, 0.0f), vec3(0.0f, -899.0f, 0.0f), 900.0f),  // larger than the patch
      sphere(vec3(0.0f), vec3(0.0f), 1.5f),                                  // on the roots
      box(vec3(0.0f, 0.2f, 0.0f), vec3(1.0f, 0.3f, 2.0f)),
      box(vec3(0.0f), vec3(100.0f)),
      box(vec3(0.0f), vec3(0.0f)),
  };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    SCOPED_TRACE(i);
    GrassInput input = field(48, {0.0f, 0.1f, 0.5f}, vec3(2.0f, 0.0f, 0.0f));
    add_collider(input, cases[i]);
    add_collider(input, sphere(vec3(0.3f, 0.1f, 0.0f), vec3(0.4f, 0.1f, 0.2f), 0.3f));
    // The twin takes another side of a box or sphere where rounding decides, which is so for few blades.
    expect_sound_frames(input, 20, 4, 5e-5, 0.9);
  }
}

TEST_F(GrassSimulationHard, knots_leave_a_collider_as_those_of_the_twin_do) {
  GrassInput input = field(60, {0.1f, 0.3f});
  shaders::GrassCollider capsule = sphere(vec3(-0.5f, 0.3f, 0.1f), vec3(-0.4f, 0.3f, 0.1f), 0.4f);
  capsule.to_previous = vec3(-0.5f, 1.3f, 0.0f);
  capsule.to = vec3(-0.4f, 1.3f, 0.0f);
  add_collider(input, capsule);
  add_collider(input, box(vec3(1.2f, 0.1f, 0.7f), vec3(0.4f, 0.35f, 0.3f)));
  expect_sound_frames(input, 1, 8);
}

/// Least distance from the ball's centre, which moves from `begin` to `end`, to a knot: by many places of the ball.
double nearest_pass(const BladeModel& blade, dvec3 begin, dvec3 end) {
  double least = 1e9;
  constexpr int kPlaces = 4000;
  for (int i = 0; i <= kPlaces; ++i) {
    const dvec3 at = glm::mix(begin, end, static_cast<double>(i) / kPlaces);
    for (std::size_t k = 1; k < kGrassKnots; ++k) least = std::min(least, glm::length(blade.root + blade.rest[k] - at));
  }
  return least;
}

// Hard case: grass.collider_100_m
TEST_F(GrassSimulationHard, a_ball_moves_every_blade_in_its_way_however_fast_it_is) {
  const dvec3 begin(-2.6, 0.15, -0.4), end(2.6, 0.15, 0.5);
  constexpr double kRadius_m = 0.12;
  for (const double speed : {20.0, 80.0, 160.0, 400.0})
    for (const std::uint32_t steps : {1u, 2u, 4u}) {
      SCOPED_TRACE(testing::Message() << speed << " m/s, " << steps << " steps a frame");
      GrassInput input = field(240, {0.3f, 0.5f});
      input.steps.frame_steps = steps;
      add_collider(input, sphere(vec3(begin), vec3(begin), static_cast<float>(kRadius_m)));
      GrassInput still = input;
      still.colliders.clear();
      still.patches[0].colliders = 0;
      const SimulateTwin twin(input);
      const SimulateKernel kernel(device());
      std::vector<double> moved(twin.models.size());
      const double frame_m = speed * steps / 120.0;
      const int frames = static_cast<int>(std::ceil(glm::length(end - begin) / frame_m));
      for (int frame = 0; frame < frames + 2; ++frame) {
        const auto place = [&](int f) {
          return vec3(glm::mix(begin, end, std::min(static_cast<double>(f) / frames, 1.0)));
        };
        input.colliders[0] = sphere(place(frame), place(frame + 1), static_cast<float>(kRadius_m));
        kernel.advance(input, 1);
        kernel.advance(still, 1);
        for (std::size_t b = 0; b < moved.size(); ++b)
          for (std::size_t k = 0; k < kGrassKnots; ++k) {
            const std::size_t at = twin.knot_index(b, k);
            moved[b] =
                std::max(moved[b], static_cast<double>(glm::length(vec3(input.knots[at]) - vec3(still.knots[at]))));
          }
      }
      std::size_t hit = 0, stood = 0, touched = 0;
      for (std::size_t b = 0; b < moved.size(); ++b) {
        const double nearest = nearest_pass(twin.models[b], begin, end);
        if (nearest < kRadius_m - 0.03) {  // blades have bent a little under their weight
          ++hit;
          stood += moved[b] < 0.005 ? 1 : 0;
        }
        touched += nearest > kRadius_m + 0.1 && moved[b] > 1e-4 ? 1 : 0;
      }
      EXPECT_GT(hit, 10u);
      EXPECT_EQ(stood, 0u) << "of " << hit;
      EXPECT_EQ(touched, 0u) << "blades beside its way";
    }
}

// Hard case: grass.collider_on_root
TEST_F(GrassSimulationHard, a_collider_on_the_root_leaves_the_root_and_moves_the_tip_out) {
  GrassInput input = field(1, {0.1f});
  const SimulateTwin twin(input);
  const auto root = vec3(twin.models[0].root);
  add_collider(input, sphere(root, root, 0.15f));
  expect_sound_frames(input, 60, 4);
  EXPECT_GT(glm::length(vec3(input.knots[15]) - root), 0.1f);
}

// Hard case: grass.stiff_10000, grass.limp_10000
TEST_F(GrassSimulationHard, ten_thousand_steps_of_stiff_and_limp_blades_come_to_rest) {
  GrassInput input = field(16, {0.0f, 0.1f, 0.9f, 1.0f});
  input.steps.iterations = 8;
  expect_sound_frames(input, static_cast<std::uint32_t>(scaled(100)), 100, 1e-3);
  for (std::size_t i = 0; i < input.knots.size(); ++i)
    EXPECT_LT(glm::length(input.knots[i] - input.previous[i]) * 120.0f, 0.005f) << i;
}

// Hard case: grass.stiff_10000, grass.limp_10000
TEST_F(GrassSimulationHard, ten_thousand_steps_in_wind_stay_sound) {
  GrassInput input = field(16, {0.0f, 0.1f, 0.9f, 1.0f}, vec3(12.0f, 1.0f, -7.0f));
  expect_sound_frames(input, static_cast<std::uint32_t>(scaled(100)), 100, 1e-3);
}

TEST_F(GrassSimulationHard, steep_ground_long_and_short_blades_stay_sound) {
  for (const float length_m : {0.001f, 0.1f, 3.0f}) {
    GrassInput input;
    for (const float s : {0.0f, 0.1f, 0.6f}) input.types.push_back(leaning_type(s));
    add_patch(input, 40, 4, 3.0f, length_m);
    input.steps.wind = {vec3(8.0f, 0.0f, 0.0f), 1.0f, vec3(0.0f)};
    SCOPED_TRACE(length_m);
    SimulateTwin twin(input);
    const SimulateKernel kernel(device());
    input.steps.frame_steps = 8;
    for (int frame = 0; frame < 30; ++frame) {
      kernel.advance(input, 1);
      const KnotFaults faults = faults_of(twin, input.knots);
      EXPECT_TRUE(faults.finite);
      // Positions in a patch of some metres are rounded to a quarter of a micrometre.
      EXPECT_LE(faults.longest, length_m < 0.01f ? 0.05 : 0.01);
      EXPECT_LE(faults.deepest_m, 2e-6);
    }
  }
}

}  // namespace
}  // namespace gloam::test
