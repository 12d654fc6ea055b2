// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/posing/skinning.h"

#include <glm/ext/matrix_double3x3.hpp>

#include "engine/core/assert.h"

namespace gloam {
namespace {

bool mirrors(const dmat4& matrix) { return glm::determinant(glm::dmat3(matrix)) < 0.0; }

}  // namespace

SkinPlacement place_joints(std::span<const dmat4> joint_worlds, std::span<const mat4> inverse_bind,
                           const dmat4& instance_world, std::span<mat4> matrices) {
  GLOAM_ASSERT(inverse_bind.size() == joint_worlds.size(), "a skin has one inverse bind matrix a joint");
  GLOAM_ASSERT(matrices.size() == joint_worlds.size(), "a skin has one joint matrix a joint");
  if (joint_worlds.empty()) return {.origin = dvec3(instance_world[3]), .mirrored = mirrors(instance_world)};

  SkinPlacement placement{.origin = dvec3(joint_worlds[0][3])};
  for (std::size_t joint = 0; joint < joint_worlds.size(); ++joint) {
    // Subtract the origin before the product: afterwards, the last digits would be lost already.
    dmat4 relative = joint_worlds[joint];
    relative[3] -= dvec4(placement.origin, 0.0);
    const dmat4 matrix = relative * dmat4(inverse_bind[joint]);
    if (joint == 0) placement.mirrored = mirrors(matrix);
    matrices[joint] = mat4(matrix);
  }
  return placement;
}

}  // namespace gloam
