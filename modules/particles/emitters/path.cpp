// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/path.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "modules/particles/emitters/births.h"

namespace gloam {
namespace {

constexpr int kJumpHalvings = 14;

/// How far the corners of the unit cube around the node move.
double pose_distance(const dmat4& a, const dmat4& b) {
  double sum = glm::length(dvec3(a[3]) - dvec3(b[3]));
  for (int i = 0; i < 3; ++i) sum += 0.5 * glm::length(dvec3(a[i]) - dvec3(b[i]));
  return sum;
}

/// The ends of the interval that a jump between two poses narrows to; none if the way between them is continuous.
std::optional<std::pair<TimedPose, TimedPose>> find_jump(const std::function<dmat4(double)>& pose_at, TimedPose a,
                                                         TimedPose b, double least) {
  for (int i = 0; i < kJumpHalvings; ++i) {
    const double whole = pose_distance(a.matrix, b.matrix);
    if (!(whole > least)) return std::nullopt;
    const double time_s = 0.5 * (a.time_s + b.time_s);
    const TimedPose middle = {time_s, pose_at(time_s)};
    const double first = pose_distance(a.matrix, middle.matrix), second = pose_distance(middle.matrix, b.matrix);
    if (std::max(first, second) < 0.75 * whole) return std::nullopt;  // both halves have their share of the way
    (first > second ? b : a) = middle;
  }
  b.time_s = a.time_s = 0.5 * (a.time_s + b.time_s);
  return std::pair(a, b);
}

}  // namespace

void note_pose(EmitterPath& path, double time_s, const dmat4& matrix, bool jumps, double lifetime_s) {
  while (!path.empty() && path.back().time_s > time_s) path.pop_back();
  if (path.empty() || time_s - path.back().time_s > kLongestPathGap_s) {
    path.assign(1, {time_s, matrix});
    return;
  }
  if (path.size() == 1 && path.back().matrix == matrix) {  // at rest
    path.back().time_s = time_s;
    return;
  }
  const auto last_jumps = [&] { return path.size() > 1 && path[path.size() - 2].time_s == path.back().time_s; };
  if (jumps && path.back().matrix != matrix) {
    const dmat4 before = path.back().matrix;
    if (last_jumps() && path.back().time_s == time_s) {
      path.back().matrix = matrix;
    } else {
      if (path.back().time_s < time_s) path.push_back({time_s, before});
      path.push_back({time_s, matrix});
    }
  } else if (path.back().time_s == time_s) {
    path.back().matrix = matrix;
  } else {
    // The last pose stays only if it is far enough from the one before, or an end of a jump.
    const double spacing = lifetime_s / static_cast<double>(kKeptPoses);
    const bool close = path.size() > 1 && path.back().time_s - path[path.size() - 2].time_s < 0.99 * spacing;
    if (close && !last_jumps()) path.pop_back();
    path.push_back({time_s, matrix});
  }
  // The first pose is the last one from before the oldest particle.
  std::size_t gone = 0;
  while (gone + 1 < path.size() && path[gone + 1].time_s <= time_s - lifetime_s) ++gone;
  if (path.size() - gone > kMostPathPoses) gone = path.size() - kMostPathPoses;
  path.erase(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(gone));
  if (rests(path)) path = {path.back()};
}

EmitterPath sampled_path(const std::function<dmat4(double)>& pose_at, double time_s, double lifetime_s,
                         double least_jump) {
  // Times do not depend on the frame's, so that the place of a birth does not either.
  const double wanted = std::max(lifetime_s * kParticleStepsPerSecond / static_cast<double>(kKeptPoses), 1.0);
  const double spacing = static_cast<double>(std::bit_ceil(static_cast<std::uint64_t>(std::ceil(wanted))));
  const auto first = static_cast<std::int64_t>(std::floor((time_s - lifetime_s) * kParticleStepsPerSecond / spacing));
  const auto last = static_cast<std::int64_t>(std::ceil(time_s * kParticleStepsPerSecond / spacing));
  EmitterPath path;
  for (std::int64_t i = first; i <= last; ++i) {
    const double at = static_cast<double>(i) * spacing / kParticleStepsPerSecond;
    const TimedPose next = {at, pose_at(at)};
    if (!path.empty() && path.size() + static_cast<std::size_t>(last - i) + 3 <= kMostPathPoses)
      if (const auto jump = find_jump(pose_at, path.back(), next, least_jump)) {
        path.push_back(jump->first);
        path.push_back(jump->second);
      }
    path.push_back(next);
  }
  return path;
}

bool rests(const EmitterPath& path) {
  return std::ranges::all_of(path, [&](const TimedPose& pose) { return pose.matrix == path.front().matrix; });
}

}  // namespace gloam
