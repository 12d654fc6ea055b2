// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "engine/math/types.h"

namespace gloam {

/// Origin of a skinned instance's matrices and whether they mirror, see JointMatrices::Range.
struct SkinPlacement {
  dvec3 origin = dvec3(0.0);
  bool mirrored = false;
};

/// Joint matrices of one instance: joint's world matrix · inverse bind matrix, composed in double relative to the
/// origin and stored as floats. Origin and mirroring are those of the first joint, or of the instance if the skin has
/// no joints. The mesh node's transform has no other effect (glTF 2.0 § 3.7.3.3). All spans have one element per joint.
SkinPlacement place_joints(std::span<const dmat4> joint_worlds, std::span<const mat4> inverse_bind,
                           const dmat4& instance_world, std::span<mat4> matrices);

}  // namespace gloam
