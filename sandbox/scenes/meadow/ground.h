// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/types.h"
#include "engine/scene/assets.h"

namespace gloam {

/// The ground of builtin:meadow, metres: a square field of grass in −kMeadowEdge…kMeadowEdge, hills around it, and a
/// path along z across both.
inline constexpr double kMeadowEdge = 12.0;

[[nodiscard]] double meadow_height(double x, double z);
/// The point of the ground at x and z, raised by `above`.
[[nodiscard]] dvec3 meadow_point(double x, double z, double above = 0.0);
[[nodiscard]] dvec3 meadow_normal(double x, double z);
/// x of the middle of the path.
[[nodiscard]] double meadow_path_x(double z);

/// Triangles that share their borders without gaps. The field's cells are about 0.25 m wide; those of the hills grow
/// with the distance.
struct MeadowGround {
  Primitive field;
  Primitive path;
  Primitive hills;
};
[[nodiscard]] MeadowGround meadow_ground_shapes();

/// Area of the triangles that face up, m².
[[nodiscard]] double upward_area_m2(const Primitive& shape);

}  // namespace gloam
