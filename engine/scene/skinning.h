// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "engine/math/types.h"

namespace gloam {

/// What a skinned instance's matrices are relative to, see JointMatrices::Range.
struct SkinPlacement {
  dvec3 origin = dvec3(0.0);
  bool mirrored = false;
};

/// Joint matrices of one instance: joint to world · inverse bind, in double, less the origin, stored as floats. The
/// origin is the world position of the first joint; of the instance where the skin has no joints. The mesh node's own
/// transform does not count otherwise (glTF 2.0 § 3.7.3.3). All spans have as many elements as the skin has joints.
SkinPlacement place_joints(std::span<const dmat4> joint_worlds, std::span<const mat4> inverse_bind,
                           const dmat4& instance_world, std::span<mat4> matrices);

}  // namespace gloam
