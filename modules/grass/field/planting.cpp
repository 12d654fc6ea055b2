// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/field/planting.h"

#include <cmath>
#include <cstddef>
#include <glm/ext/matrix_double3x3.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/math/finite.h"

namespace gloam {
namespace {

using glm::dmat3;

constexpr double kMostStretch = 0.15;

/// Greatest magnitude of an element of a - b.
double greatest_difference(const dmat3& a, const dmat3& b) {
  double greatest = 0.0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) greatest = std::max(greatest, std::abs(a[column][row] - b[column][row]));
  return greatest;
}

/// The rotation nearest to a matrix that is nearly one (polar decomposition by Newton's iteration: Higham, "Computing
/// the polar decomposition", 1986).
dmat3 nearest_rotation(dmat3 m) {
  for (int i = 0; i < 8; ++i) m = 0.5 * (m + glm::transpose(glm::inverse(m)));
  return m;
}

}  // namespace

std::optional<CarriedGround> carried_ground(const dmat4& planted, const dmat4& now) {
  CarriedGround ground{.from = dvec3(planted[3]), .to = dvec3(now[3])};
  if (!is_finite(ground.from) || !is_finite(ground.to)) return std::nullopt;
  const dmat3 before(planted);
  const dmat3 after(now);
  if (before == after) return ground;
  const dmat3 linear = after * glm::inverse(before);
  for (int column = 0; column < 3; ++column)
    if (!is_finite(linear[column])) return std::nullopt;
  if (!(glm::determinant(linear) > 0.1)) return std::nullopt;
  const dmat3 rotation = nearest_rotation(linear);
  if (!(greatest_difference(glm::transpose(rotation) * linear, dmat3(1.0)) <= kMostStretch)) return std::nullopt;
  ground.turns = true;
  ground.linear = dmat4(linear);
  ground.turn = glm::normalize(glm::quat_cast(rotation));
  return ground;
}

bool carry_patches(const CarriedGround& ground, std::span<const dvec3> origins, double dt_s,
                   std::span<GrassPatch> patches, std::span<GrassPatchMotion> motions) {
  bool moving = false;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    GrassPatch& patch = patches[i];
    GrassPatchMotion& motion = motions[i];
    const dvec3 origin = ground.place(origins[i]);
    motion.carried = origin - patch.origin;
    motion.previous_turn = patch.turn;
    patch.origin = origin;
    patch.turn = ground.turn;
    moving = moving || motion.carried != dvec3(0.0) || motion.previous_turn != patch.turn ||
             motion.velocity != dvec3(0.0) || motion.push != vec3(0.0f);
    if (!(dt_s > 0.0)) continue;
    const dvec3 velocity = motion.carried / dt_s;
    const dvec3 push = (motion.velocity - velocity) / dt_s;
    const double strength = glm::length(push);
    motion.push = std::isfinite(strength)
                      ? vec3(strength > kMostGroundPush ? push * (kMostGroundPush / strength) : push)
                      : vec3(0.0f);
    motion.velocity = std::isfinite(strength) ? velocity : dvec3(0.0);
  }
  return moving;
}

}  // namespace gloam
