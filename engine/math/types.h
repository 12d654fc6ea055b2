// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

// The library is compiled with this order of a quaternion's numbers.
#ifdef GLM_FORCE_QUAT_DATA_WXYZ
#error "gloam's quaternions are stored x, y, z, w: compile sources that include gloam without GLM_FORCE_QUAT_DATA_WXYZ"
#endif

#include "shaders/common/vectors.h"

#include <cstdint>
#include <glm/common.hpp>
#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/quaternion_double.hpp>
#include <glm/ext/quaternion_float.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_double4.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gloam {

using glm::dmat4;
using glm::dquat;
using glm::dvec3;
using glm::dvec4;
using glm::quat;

static_assert(sizeof(dvec3) == 24, "gloam's types are packed: GLM is configured with aligned types");

inline constexpr float kPi = 3.14159265358979323846f;

}  // namespace gloam
