// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/meadow/motion.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "engine/scene/posing/animation.h"
#include "sandbox/scenes/meadow/ground.h"

namespace gloam {
namespace {

constexpr double kTurn = 2.0 * static_cast<double>(kPi);
constexpr double kKeyStep_s = 0.1;
constexpr int kSamples = 4096;  // of a loop's length

dvec3 loop_point(const MeadowLoop& loop, double share) {
  const double angle = kTurn * loop.turns * share;
  const double radius = loop.radius_m * (1.0 + loop.wave * std::cos(kTurn * loop.waves * share));
  return meadow_point(loop.x + radius * std::cos(angle), loop.z + radius * std::sin(angle));
}

/// Calls pose(time_s) at each key of a round, the last one included.
template <typename Pose>
std::vector<PoseKey> keys_of_round(double duration_s, Pose&& pose) {
  std::vector<PoseKey> keys;
  const int count = static_cast<int>(std::lround(duration_s / kKeyStep_s));
  for (int i = 0; i <= count; ++i) keys.push_back(pose(duration_s * i / count));
  keys.back().time_s = duration_s;
  return keys;
}

dvec3 ball_centre(const MeadowWalk& walk, double time_s, double radius_m) {
  const dvec3 contact = walk.at(time_s);
  return contact + radius_m * meadow_normal(contact.x, contact.z);
}

}  // namespace

MeadowWalk::MeadowWalk(const MeadowLoop& loop) : loop_(loop), lengths_{0.0} {
  for (int i = 1; i <= kSamples; ++i) {
    const dvec3 from = loop_point(loop, static_cast<double>(i - 1) / kSamples);
    lengths_.push_back(lengths_.back() + glm::length(loop_point(loop, static_cast<double>(i) / kSamples) - from));
  }
}

dvec3 MeadowWalk::at(double time_s) const {
  const double rounds = loop_.start + (loop_.backwards ? -time_s : time_s) / loop_.duration_s;
  const double length = (rounds - std::floor(rounds)) * length_m();
  const auto next =
      std::clamp<std::ptrdiff_t>(std::ranges::upper_bound(lengths_, length) - lengths_.begin(), 1, kSamples);
  const double before = lengths_[static_cast<std::size_t>(next - 1)];
  const double after = lengths_[static_cast<std::size_t>(next)];
  return loop_point(loop_, (static_cast<double>(next - 1) + (length - before) / (after - before)) / kSamples);
}

dvec3 MeadowWalk::direction(double time_s) const {
  const dvec3 along = at(time_s + 0.05) - at(time_s - 0.05);
  return glm::normalize(dvec3(along.x, 0.0, along.z));
}

std::vector<PoseKey> walking_keys(const MeadowLoop& loop) {
  const MeadowWalk walk(loop);
  return keys_of_round(loop.duration_s, [&](double time_s) {
    const dvec3 along = walk.direction(time_s);
    return PoseKey{time_s, walk.at(time_s), glm::angleAxis(std::atan2(along.x, along.z), dvec3(0.0, 1.0, 0.0))};
  });
}

std::vector<PoseKey> rolling_keys(const MeadowLoop& loop, double radius_m) {
  constexpr int kSteps = 16;  // between two keys
  const MeadowWalk walk(loop);
  dquat rotation(1.0, 0.0, 0.0, 0.0);
  double now_s = 0.0;
  dvec3 centre = ball_centre(walk, 0.0, radius_m);
  std::vector<PoseKey> keys = keys_of_round(loop.duration_s, [&](double time_s) {
    const double begin_s = now_s;
    for (int i = 1; i <= kSteps && time_s > begin_s; ++i) {
      now_s = begin_s + (time_s - begin_s) * i / kSteps;
      const dvec3 contact = walk.at(now_s), next = ball_centre(walk, now_s, radius_m);
      const dvec3 turn = glm::cross(meadow_normal(contact.x, contact.z), next - centre) / radius_m;
      rotation = glm::normalize(glm::angleAxis(glm::length(turn), glm::normalize(turn)) * rotation);
      centre = next;
    }
    return PoseKey{time_s, centre, rotation};
  });
  const dquat still(1.0, 0.0, 0.0, 0.0), back = glm::conjugate(rotation);
  for (PoseKey& key : keys) key.rotation = slerp_shortest(still, back, key.time_s / loop.duration_s) * key.rotation;
  return keys;
}

std::vector<PoseKey> looking_keys(const MeadowLoop& loop, double eye_m) {
  constexpr double kAhead_s = 1.5;
  const MeadowWalk walk(loop);
  return keys_of_round(loop.duration_s, [&](double time_s) {
    const dvec3 eye = walk.at(time_s) + dvec3(0.0, eye_m, 0.0);
    const dvec3 ahead = eye + walk.direction(time_s + kAhead_s) - dvec3(0.0, 0.14, 0.0);
    return PoseKey{time_s, eye, rotation_towards(ahead - eye)};
  });
}

std::vector<PoseKey> swinging_keys(dvec3 joint, double angle, double duration_s) {
  return keys_of_round(duration_s, [&](double time_s) {
    const double swing = angle * std::sin(kTurn * time_s / duration_s);
    return PoseKey{time_s, joint, glm::angleAxis(swing, dvec3(1.0, 0.0, 0.0))};
  });
}

}  // namespace gloam
