// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/math/types.h"
#include "sandbox/scenes/construction/scene_builder.h"

namespace gloam {

/// A closed curve over the ground of builtin:meadow. At the share s of it (0…1) the direction from the centre has the
/// angle turns · 2π · s, from +X towards +Z, and the distance is radius_m · (1 + wave · cos(waves · 2π · s)).
struct MeadowLoop {
  double x = 0.0;  ///< centre
  double z = 0.0;
  double radius_m = 2.0;
  double wave = 0.0;
  int waves = 1;
  int turns = 1;
  double duration_s = 20.0;  ///< of one round; a multiple of 0.1 s
  double start = 0.0;        ///< share of its length, 0…1, at which it starts
  bool backwards = false;
};

/// Motion along a loop at constant speed.
class MeadowWalk {
 public:
  explicit MeadowWalk(const MeadowLoop& loop);

  [[nodiscard]] double length_m() const { return lengths_.back(); }
  /// The point of the ground at this time, also after the first round.
  [[nodiscard]] dvec3 at(double time_s) const;
  /// Horizontal direction of the motion, unit length.
  [[nodiscard]] dvec3 direction(double time_s) const;

 private:
  MeadowLoop loop_;
  std::vector<double> lengths_;  ///< from the loop's first point, at equal steps of its share
};

/// Poses of a figure that walks the loop upright, facing along its +Z.
[[nodiscard]] std::vector<PoseKey> walking_keys(const MeadowLoop& loop);

/// Poses of a ball that rolls along the loop without slipping, except for a slow turn that brings it back to its first
/// orientation after a round.
[[nodiscard]] std::vector<PoseKey> rolling_keys(const MeadowLoop& loop, double radius_m);

/// Poses of a camera at eye_m above the ground that looks along its way.
[[nodiscard]] std::vector<PoseKey> looking_keys(const MeadowLoop& loop, double eye_m);

/// Poses of an arm or a leg of someone who walks: it swings about the local x axis of its joint.
[[nodiscard]] std::vector<PoseKey> swinging_keys(dvec3 joint, double angle, double duration_s);

}  // namespace gloam
