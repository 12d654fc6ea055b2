// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/posing/animation.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

AnimationChannel channel_of(AnimationPath path, Interpolation interpolation, std::uint32_t width,
                            std::vector<float> times, std::vector<float> values) {
  return {.node = 0,
          .path = path,
          .interpolation = interpolation,
          .width = width,
          .times = std::move(times),
          .values = std::move(values)};
}

std::vector<double> sample(const AnimationChannel& channel, double time_s) {
  std::vector<double> out(channel.width, -77.0);
  sample_channel(channel, time_s, out);
  return out;
}

dquat sample_rotation(const AnimationChannel& channel, double time_s) {
  const auto v = sample(channel, time_s);
  return dquat(v[3], v[0], v[1], v[2]);
}

double dot4(const dquat& a, const dquat& b) { return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w; }

/// Angle between unit quaternions in four dimensions; accurate for small angles.
long double arc(const dquat& a, const dquat& b) {
  long double minus = 0.0L;
  long double plus = 0.0L;
  const std::array<long double, 4> p{a.x, a.y, a.z, a.w};
  const std::array<long double, 4> q{b.x, b.y, b.z, b.w};
  for (std::size_t i = 0; i < 4; ++i) {
    minus += (p[i] - q[i]) * (p[i] - q[i]);
    plus += (p[i] + q[i]) * (p[i] + q[i]);
  }
  return 2.0L * std::atan2(std::sqrt(minus), std::sqrt(plus));
}

dquat about_z(double radians) { return dquat(std::cos(radians / 2.0), 0.0, 0.0, std::sin(radians / 2.0)); }

void expect_on_arc(const dquat& from, const dquat& to_on_short_side, double u) {
  const dquat mixed = slerp_shortest(from, to_on_short_side, u);
  const long double whole = arc(from, to_on_short_side);
  EXPECT_NEAR(std::sqrt(dot4(mixed, mixed)), 1.0, 1e-15);
  EXPECT_NEAR(static_cast<double>(arc(from, mixed)), static_cast<double>(u * whole),
              1e-15 + 1e-9 * static_cast<double>(whole));
  EXPECT_NEAR(static_cast<double>(arc(mixed, to_on_short_side)), static_cast<double>((1.0L - u) * whole),
              1e-15 + 1e-9 * static_cast<double>(whole));
}

// Hard case: further.time_backwards
TEST(Animation, time_loops_by_the_duration_forwards_and_backwards) {
  EXPECT_DOUBLE_EQ(looped_time(0.25, 2.0), 0.25);
  EXPECT_DOUBLE_EQ(looped_time(2.0, 2.0), 0.0);
  EXPECT_DOUBLE_EQ(looped_time(7.5, 2.0), 1.5);
  EXPECT_DOUBLE_EQ(looped_time(-0.5, 2.0), 1.5);
  EXPECT_DOUBLE_EQ(looped_time(3.0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(looped_time(3.0, -1.0), 0.0);
}

TEST(Animation, looped_time_never_reaches_the_duration) {
  EXPECT_LT(looped_time(-1e-300, 2.0), 2.0);
  EXPECT_LT(looped_time(-1e-17, 1.0), 1.0);
  EXPECT_GE(looped_time(-1e-17, 1.0), 0.0);
}

TEST(Animation, before_the_first_key_and_after_the_last_the_end_values_hold) {
  for (const auto interpolation : {Interpolation::step, Interpolation::linear}) {
    const auto channel =
        channel_of(AnimationPath::translation, interpolation, 3, {1.0f, 2.0f}, {1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f});
    EXPECT_EQ(sample(channel, 0.0), (std::vector{1.0, 2.0, 3.0}));
    EXPECT_EQ(sample(channel, 1.0), (std::vector{1.0, 2.0, 3.0}));
    EXPECT_EQ(sample(channel, 2.0), (std::vector{4.0, 5.0, 6.0}));
    EXPECT_EQ(sample(channel, 9.0), (std::vector{4.0, 5.0, 6.0}));
  }
}

TEST(Animation, a_single_key_holds_for_ever) {
  const auto channel = channel_of(AnimationPath::scale, Interpolation::linear, 3, {1.0f}, {1.0f, 2.0f, 3.0f});
  for (const double time : {-1.0, 0.0, 1.0, 5.0}) EXPECT_EQ(sample(channel, time), (std::vector{1.0, 2.0, 3.0}));
}

TEST(Animation, step_keeps_a_key_until_the_next_one) {
  const auto channel =
      channel_of(AnimationPath::weights, Interpolation::step, 1, {0.0f, 1.0f, 2.0f}, {5.0f, 6.0f, 7.0f});
  EXPECT_EQ(sample(channel, 0.999999).front(), 5.0);
  EXPECT_EQ(sample(channel, 1.0).front(), 6.0);
  EXPECT_EQ(sample(channel, 1.5).front(), 6.0);
}

TEST(Animation, linear_mixes_the_two_keys_around_a_time) {
  const auto channel = channel_of(AnimationPath::weights, Interpolation::linear, 2, {0.0f, 2.0f, 3.0f},
                                  {0.0f, 10.0f, 4.0f, 20.0f, 8.0f, -20.0f});
  EXPECT_EQ(sample(channel, 0.5), (std::vector{1.0, 12.5}));
  EXPECT_EQ(sample(channel, 2.25), (std::vector{5.0, 10.0}));
}

TEST(Animation, cubic_follows_the_hermite_polynomial_with_tangents_per_second) {
  // One segment of 2 s: p0 = 1, m0 = 3, p1 = 5, m1 = −4, against the expanded polynomial.
  const auto channel = channel_of(AnimationPath::weights, Interpolation::cubic, 1, {1.0f, 3.0f},
                                  {99.0f, 1.0f, 3.0f, -4.0f, 5.0f, 99.0f});
  for (int i = 0; i <= 16; ++i) {
    const double u = i / 16.0;
    const double a = 2.0 * 1.0 - 2.0 * 5.0 + 2.0 * 3.0 + 2.0 * -4.0;
    const double b = -3.0 * 1.0 + 3.0 * 5.0 - 2.0 * 2.0 * 3.0 - 2.0 * -4.0;
    const double expected = ((a * u + b) * u + 2.0 * 3.0) * u + 1.0;
    EXPECT_NEAR(sample(channel, 1.0 + 2.0 * u).front(), expected, 1e-14) << u;
  }
  EXPECT_EQ(sample(channel, 0.0).front(), 1.0);
  EXPECT_EQ(sample(channel, 4.0).front(), 5.0);
}

TEST(Animation, cubic_rotations_are_normalised) {
  const auto channel = channel_of(AnimationPath::rotation, Interpolation::cubic, 4, {0.0f, 1.0f},
                                  {0, 0, 0, 0, 0, 0, 0, 1, 3, 0, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0});
  for (const double time : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    const dquat q = sample_rotation(channel, time);
    EXPECT_NEAR(dot4(q, q), 1.0, 1e-15) << time;
  }
}

TEST(Animation, rotations_take_the_shorter_arc_between_opposite_signs) {
  const dquat a = about_z(0.2);
  const dquat b = about_z(1.0);
  const dquat expected = about_z(0.6);
  const dquat minus_b(-b.w, -b.x, -b.y, -b.z);
  EXPECT_NEAR(std::abs(dot4(slerp_shortest(a, b, 0.5), expected)), 1.0, 1e-15);
  EXPECT_NEAR(std::abs(dot4(slerp_shortest(a, minus_b, 0.5), expected)), 1.0, 1e-15);
}

TEST(Animation, a_quaternion_and_its_negative_are_one_rotation_throughout) {
  const dquat a = about_z(0.7);
  const dquat minus_a(-a.w, -a.x, -a.y, -a.z);
  for (const double u : {0.0, 0.25, 0.5, 1.0})
    EXPECT_NEAR(std::abs(dot4(slerp_shortest(a, minus_a, u), a)), 1.0, 1e-15) << u;
}

TEST(Animation, slerp_is_even_in_angle_for_near_and_far_rotations) {
  for (const double angle : {0.0, 1e-14, 1e-9, 1.9e-6, 2.1e-6, 1e-4, 0.01, 1.0, 3.0, 3.1415}) {
    for (const double u : {0.0, 0.1, 0.5, 0.75, 1.0}) expect_on_arc(about_z(0.3), about_z(0.3 + angle), u);
  }
}

TEST(Animation, half_a_turn_apart_stays_on_one_arc) {
  const dquat from = about_z(0.0);
  const dquat to(0.0, 0.0, 0.0, 1.0);
  for (const double u : {0.25, 0.5, 0.75}) expect_on_arc(from, to, u);
}

TEST(Animation, unnormalised_and_zero_rotation_keys_give_unit_rotations) {
  const auto scaled =
      channel_of(AnimationPath::rotation, Interpolation::linear, 4, {0.0f, 1.0f}, {0, 0, 0, 3, 0, 0, 5, 0});
  EXPECT_NEAR(std::abs(dot4(sample_rotation(scaled, 0.5), about_z(3.14159265358979 / 2.0))), 1.0, 1e-12);
  const auto zero = channel_of(AnimationPath::rotation, Interpolation::step, 4, {0.0f}, {0, 0, 0, 0});
  EXPECT_EQ(sample(zero, 0.0), (std::vector{0.0, 0.0, 0.0, 1.0}));
}

TEST(Animation, wrong_sizes_assert) {
  auto channel = channel_of(AnimationPath::scale, Interpolation::linear, 3, {0.0f}, {1.0f, 2.0f, 3.0f});
  std::array<double, 2> narrow{};
  EXPECT_ASSERT(sample_channel(channel, 0.0, narrow), "exactly `width`");
  std::array<double, 3> out{};
  channel.interpolation = Interpolation::cubic;
  EXPECT_ASSERT(sample_channel(channel, 0.0, out), "three times as many");
  channel.times.clear();
  EXPECT_ASSERT(sample_channel(channel, 0.0, out), "at least one key");
}

// Hard case: scene.same_target
TEST(Animation, of_clips_that_move_the_same_target_the_first_plays) {
  const auto moves = [](std::uint32_t node, AnimationPath path) {
    AnimationChannel channel;
    channel.node = node;
    channel.path = path;
    return channel;
  };
  std::vector<AnimationClip> clips(2);
  clips[0].channels = {moves(0, AnimationPath::translation), moves(9, AnimationPath::scale)};
  clips[1].channels = {moves(0, AnimationPath::translation), moves(0, AnimationPath::rotation),
                       moves(1, AnimationPath::weights)};
  SceneNodes nodes;
  nodes.entities = {Entity{4, 1}, Entity{5, 1}};
  AnimationBindings bindings;
  bind_animations(clips, nodes, bindings);
  ASSERT_EQ(bindings.poses.size(), 2u);
  EXPECT_EQ(bindings.poses[0].clip, 0u);
  EXPECT_EQ(bindings.poses[0].entity, (Entity{4, 1}));
  EXPECT_EQ(bindings.poses[1].clip, 1u);
  EXPECT_EQ(bindings.poses[1].channel, 1u);
  ASSERT_EQ(bindings.weights.size(), 1u);
  EXPECT_EQ(bindings.weights[0].entity, (Entity{5, 1}));
}

}  // namespace
}  // namespace gloam
