// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/reference/deform_twin.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_double3x3.hpp>
#include <numbers>

namespace gloam {
namespace {

dvec3 unit_or_zero(const dvec3& v) { return glm::length(v) > 1e-12 ? glm::normalize(v) : dvec3(0.0); }

}  // namespace

double degrees_between(const dvec3& a, const dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / std::numbers::pi;
}

dvec3 decoded_direction(std::uint32_t packed) {
  const auto snorm = [](std::uint32_t bits) {
    return std::max(static_cast<std::int16_t>(bits & 0xFFFFu) / 32767.0, -1.0);
  };
  dvec3 n(snorm(packed), snorm(packed >> 16), 0.0);
  n.z = 1.0 - std::abs(n.x) - std::abs(n.y);
  if (n.z < 0.0) {
    const double x = (1.0 - std::abs(n.y)) * (n.x < 0.0 ? -1.0 : 1.0);
    n.y = (1.0 - std::abs(n.x)) * (n.y < 0.0 ? -1.0 : 1.0);
    n.x = x;
  }
  return glm::normalize(n);
}

DeformedVertex DeformTwin::move(std::size_t vertex) const {
  const Primitive& p = input_.primitive;
  DeformedVertex moved{dvec3(p.positions[vertex]), decoded_direction(frames_[vertex].normal),
                       decoded_direction(frames_[vertex].tangent & ~kHandednessBit),
                       (frames_[vertex].tangent & kHandednessBit) != 0};
  for (std::uint32_t t = 0; t < input_.constants.morph_targets; ++t) {
    const double weight = static_cast<double>(input_.weights[input_.constants.first_weight + t]);
    moved.position += weight * dvec3(p.morph_targets[t].positions[vertex]);
    if (input_.constants.morph_has_normals != 0) moved.normal += weight * dvec3(p.morph_targets[t].normals[vertex]);
  }
  if (input_.constants.skinned != 0) skin(vertex, moved);
  moved.normal = unit_or_zero(moved.normal);
  moved.tangent = unit_or_zero(moved.tangent);
  return moved;
}

void DeformTwin::skin(std::size_t vertex, DeformedVertex& moved) const {
  const PackedInfluence& p = influences_[vertex];
  const std::uint32_t joints[] = {p.joints01 & 0xFFFFu, p.joints01 >> 16, p.joints23 & 0xFFFFu, p.joints23 >> 16};
  const std::uint32_t weights[] = {p.weights01 & 0xFFFFu, p.weights01 >> 16, p.weights23 & 0xFFFFu, p.weights23 >> 16};
  dmat4 blended(0.0);
  for (std::size_t k = 0; k < 4; ++k)
    blended += weights[k] / 65535.0 * dmat4(input_.joints[input_.constants.first_joint + joints[k]]);
  const glm::dmat3 linear(blended);
  // Cofactor matrix: the inverse transpose times the determinant, but without a division.
  const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                             glm::cross(linear[0], linear[1]));
  const double side = glm::determinant(linear) < 0.0 ? -1.0 : 1.0;
  moved.position = dvec3(blended * dvec4(moved.position, 1.0));
  moved.normal = side * (cofactors * moved.normal);
  moved.tangent = linear * moved.tangent;
  moved.left_handed = moved.left_handed != (side < 0.0);
}

}  // namespace gloam
