// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/ext/matrix_transform.hpp>

namespace gloam::test {
namespace {

dmat4 at(double x, double y = 0.0) { return glm::translate(dmat4(1.0), dvec3(x, y, 0.0)); }

/// Where a birth at a time is, by searching all poses from the newest back.
dvec3 birth_at(const EmitterPath& path, double time_s) {
  if (time_s <= path.front().time_s) return dvec3(path.front().matrix[3]);
  for (std::size_t i = path.size() - 1; i > 0; --i) {
    const TimedPose &a = path[i - 1], &b = path[i];
    if (a.time_s < time_s && time_s <= b.time_s)
      return glm::mix(dvec3(a.matrix[3]), dvec3(b.matrix[3]), (time_s - a.time_s) / (b.time_s - a.time_s));
  }
  return dvec3(path.back().matrix[3]);
}

/// Notes the poses of a way at 60 Hz.
EmitterPath played(const std::function<dmat4(double)>& way, double from, double to, double lifetime_s,
                   EmitterPath path = {}) {
  for (int i = 0; from + i / 60.0 < to + 1e-9; ++i)
    note_pose(path, from + i / 60.0, way(from + i / 60.0), false, lifetime_s);
  return path;
}

dmat4 circle(double t) { return at(std::cos(3.0 * t), std::sin(3.0 * t)); }

TEST(NotedPath, is_the_way_of_the_emitter_within_its_bound) {
  for (const double life : {0.5, 2.0, 6.0}) {
    const EmitterPath path = played(circle, 0.0, 9.0, life);
    EXPECT_LE(path.size(), kMostPathPoses);
    const double spacing = std::max(1.0 / 60.0, 1.02 * life / kKeptPoses + 1.0 / 60.0);
    for (double t = 9.0 - life; t <= 9.0; t += 0.0037)
      EXPECT_LT(glm::length(birth_at(path, t) - dvec3(circle(t)[3])), 9.0 * spacing * spacing / 8.0 + 1e-9) << t;
    EXPECT_LE(path.front().time_s, 9.0 - life + 1e-9);
    EXPECT_GT(path[1].time_s, 9.0 - life);
  }
}

TEST(NotedPath, of_an_emitter_at_rest_is_one_pose_again_after_a_lifetime) {
  EmitterPath path = played(circle, 0.0, 3.0, 2.0);
  const dmat4 last = circle(3.0);
  path = played([&](double) { return last; }, 3.0, 4.9, 2.0, path);
  EXPECT_GT(path.size(), 1u);
  path = played([&](double) { return last; }, 4.9, 5.2, 2.0, path);
  EXPECT_EQ(path.size(), 1u);
  EXPECT_EQ(path.back().matrix, last);
}

TEST(NotedPath, of_a_teleport_has_births_at_either_place_only) {
  EmitterPath path;
  note_pose(path, 1.0, at(0.0), false, 2.0);
  note_pose(path, 1.1, at(0.0), false, 2.0);
  note_pose(path, 1.2, at(50.0), true, 2.0);
  note_pose(path, 1.3, at(51.0), false, 2.0);
  EXPECT_EQ(birth_at(path, 1.15).x, 0.0);
  EXPECT_EQ(birth_at(path, 1.2).x, 0.0) << "until the frame that shows it elsewhere";
  EXPECT_NEAR(birth_at(path, 1.25).x, 50.5, 1e-12);
  // Another jump in the same frame goes on from the first.
  note_pose(path, 1.3, at(90.0), true, 2.0);
  note_pose(path, 1.3, at(95.0), true, 2.0);
  EXPECT_NEAR(birth_at(path, 1.25).x, 50.5, 1e-12);
  note_pose(path, 1.4, at(95.0), false, 2.0);
  EXPECT_EQ(birth_at(path, 1.35).x, 95.0);
}

TEST(NotedPath, does_not_change_while_the_clock_stands) {
  EmitterPath path = played(circle, 0.0, 2.0, 1.0);
  const EmitterPath before = path;
  for (int i = 0; i < 50; ++i) note_pose(path, 2.0, path.back().matrix, true, 1.0);
  ASSERT_EQ(path.size(), before.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_EQ(path[i].time_s, before[i].time_s);
    EXPECT_EQ(path[i].matrix, before[i].matrix);
  }
}

TEST(NotedPath, forgets_later_poses_when_the_clock_goes_back) {
  EmitterPath path = played(circle, 0.0, 1.0, 1.0), longer = played(circle, 0.0, 1.5, 1.0);
  note_pose(longer, 1.0, circle(1.0), false, 1.0);
  for (double t = 0.5; t <= 1.0; t += 0.01) EXPECT_LT(glm::length(birth_at(path, t) - birth_at(longer, t)), 1e-12) << t;
  note_pose(longer, -7.0, at(3.0), false, 1.0);
  EXPECT_EQ(longer.size(), 1u) << "before all poses: it has always been there";
  EXPECT_EQ(longer[0].matrix, at(3.0));
}

TEST(NotedPath, forgets_poses_before_a_long_gap) {
  EmitterPath path = played(circle, 0.0, 1.0, 5.0);
  note_pose(path, 1.0 + 1.01 * kLongestPathGap_s, at(9.0), false, 5.0);
  EXPECT_EQ(path.size(), 1u);
}

TEST(NotedPath, stays_bounded_with_a_jump_in_every_frame) {
  EmitterPath path;
  for (int i = 0; i < 2000; ++i) {
    note_pose(path, i / 240.0, at(i), true, 5.0);
    ASSERT_LE(path.size(), kMostPathPoses);
  }
  EXPECT_EQ(birth_at(path, 1999 / 240.0 - 1e-4).x, 1998.0);
}

TEST(SampledPath, is_the_way_within_its_bound_at_all_frames_alike) {
  const auto way = [](double t) { return glm::rotate(circle(t), 0.7 * t, dvec3(0.0, 0.0, 1.0)); };
  for (const double now : {4.0, 4.013, 4.1}) {
    const EmitterPath path = sampled_path(way, now, 2.0, 0.05);
    EXPECT_LE(path.size(), kKeptPoses + 4);
    EXPECT_LE(path.front().time_s, now - 2.0);
    EXPECT_GE(path.back().time_s, now);
    for (double t = now - 2.0; t <= now; t += 0.0017)
      EXPECT_LT(glm::length(birth_at(path, t) - dvec3(way(t)[3])), 9.0 * std::pow(2.0 * 2.0 / kKeptPoses, 2.0) / 8.0);
  }
  // The place of a birth does not depend on the frame that shows it.
  const EmitterPath a = sampled_path(way, 4.0, 2.0, 0.05), b = sampled_path(way, 4.37, 2.0, 0.05);
  for (double t = 2.37; t <= 4.0; t += 0.003) EXPECT_LT(glm::length(birth_at(a, t) - birth_at(b, t)), 1e-12);
}

TEST(SampledPath, finds_jumps_of_steps_and_loops) {
  // A loop of 0.7 s that ends 3 m away from its start, and a step to the side within it.
  const auto way = [](double t) {
    const double in_loop = t - 0.7 * std::floor(t / 0.7);
    return at(3.0 * in_loop / 0.7, in_loop < 0.3123 ? 0.0 : 2.0);
  };
  const EmitterPath path = sampled_path(way, 5.0, 4.0, 0.05);
  std::size_t wrong = 0, all = 0;
  for (double t = 1.0; t <= 5.0; t += 0.0001, ++all)
    wrong += glm::length(birth_at(path, t) - dvec3(way(t)[3])) > 1e-4 ? 1 : 0;
  EXPECT_LT(wrong, all / 2000) << "only within the time to which a jump is found";
}

TEST(SampledPath, of_jumps_everywhere_stays_bounded) {
  const auto way = [](double t) { return at(std::fmod(std::floor(t * 1000.0) * 7.77, 100.0)); };
  EXPECT_LE(sampled_path(way, 5.0, 4.0, 0.05).size(), kMostPathPoses);
}

}  // namespace
}  // namespace gloam::test
