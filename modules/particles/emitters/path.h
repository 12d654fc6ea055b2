// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Where moving emitters were when their live particles were born. Particles are a function of the time and of this
// path; nothing else is kept.
//
// An emitter that an animation moves has the poses that the animation gives at earlier times, so that a frame depends
// on its time only: after a seek it is the frame that playing leads to. Its ancestors without an animation count as
// where they are now.
//
// Of any other emitter the world notes its pose in each frame:
//  - between two frames it moves in a straight line at an even speed;
//  - if it or an ancestor is listed in Teleports, or if it moves while the clock stands, it was at its old pose until
//    this frame;
//  - when the clock goes back, poses of later times are forgotten; before its first pose it was at that one;
//  - after more than kLongestPathGap_s without a frame its earlier poses are forgotten.
// The world keeps a bounded number of poses over the lifetime of a particle (kKeptPoses); those between are replaced by
// the straight line, which is wrong by at most a · (lifetime / kKeptPoses)² / 8 at an acceleration of a.
#pragma once

#include <cstddef>
#include <functional>
#include <unordered_map>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/math/types.h"

namespace gloam {

/// Poses over a lifetime, at even times.
inline constexpr std::size_t kKeptPoses = 120;
/// Poses of a path in all: with two for each jump. Jumps beyond that become straight lines.
inline constexpr std::size_t kMostPathPoses = 256;
inline constexpr double kLongestPathGap_s = 1.0;

/// The emitter's matrix at a time. Two poses of the same time are a jump: births until then are at the first.
struct TimedPose {
  double time_s = 0.0;
  dmat4 matrix = dmat4(1.0);
};

/// Poses in order of time.
using EmitterPath = std::vector<TimedPose>;

/// Adds the pose of a frame to a noted path. jumps: the emitter was at its last pose until time_s. The path then ends
/// with (time_s, matrix), and its first pose is the last one that is not younger than lifetime_s.
void note_pose(EmitterPath& path, double time_s, const dmat4& matrix, bool jumps, double lifetime_s);

/// The path of an emitter whose pose is a function of time, over the lifetime before time_s. Jumps of more than
/// least_jump (units of the world) are found to 1e-5 s.
[[nodiscard]] EmitterPath sampled_path(const std::function<dmat4(double)>& pose_at, double time_s, double lifetime_s,
                                       double least_jump);

/// Whether all poses are the same: the emitter rests.
[[nodiscard]] bool rests(const EmitterPath& path);

/// The noted paths of emitters; a world resource of system particle_emitters.
struct EmitterPaths {
  std::unordered_map<Entity, EmitterPath> paths;
};

}  // namespace gloam
