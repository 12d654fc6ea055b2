// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/posing/camera_poses.h"

#include <algorithm>
#include <cmath>

#include "engine/math/finite.h"

namespace gloam {
namespace {

/// Sine of the smallest angle between two columns that counts as a difference. Columns of a file are floats.
constexpr double kLeastSine = 1e-6;

/// A unit vector along v, also if the square of its length leaves the range of doubles. Zero if v has no length or is
/// not finite.
dvec3 direction_of(const dvec3& v) {
  const double greatest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return is_finite(v) && greatest > 0.0 ? glm::normalize(v / greatest) : dvec3(0.0);
}

/// A unit vector at right angles to two unit vectors; zero if they have the same direction or one is zero.
dvec3 normal_of(const dvec3& a, const dvec3& b) {
  const dvec3 normal = glm::cross(a, b);
  const double sine = glm::length(normal);
  return sine > kLeastSine ? normal / sine : dvec3(0.0);
}

bool is_zero(const dvec3& v) { return v == dvec3(0.0); }

}  // namespace

std::optional<dmat4> rigid_pose(const dmat4& world_from_node) {
  const dvec3 position(world_from_node[3]);
  if (!is_finite(position)) return std::nullopt;
  dvec3 x = direction_of(dvec3(world_from_node[0]));
  dvec3 y = direction_of(dvec3(world_from_node[1]));
  dvec3 z = direction_of(dvec3(world_from_node[2]));
  if (is_zero(z)) z = normal_of(x, y);
  if (const dvec3 right = normal_of(y, z); !is_zero(right))
    x = right;
  else
    x = normal_of(normal_of(z, x), z);
  if (is_zero(x) || is_zero(z)) return std::nullopt;
  y = glm::cross(z, x);
  return dmat4(dvec4(x, 0.0), dvec4(y, 0.0), dvec4(z, 0.0), dvec4(position, 1.0));
}

const dmat4* CameraPoses::find(Entity camera) const {
  const auto row = std::ranges::lower_bound(rows, camera.index, {}, [](const Row& r) { return r.camera.index; });
  return row != rows.end() && row->camera == camera ? &row->world_from_camera : nullptr;
}

}  // namespace gloam
