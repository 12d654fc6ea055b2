// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

// The library is compiled with GLM's packed types. These settings change their layout.
#if defined(GLM_FORCE_DEFAULT_ALIGNED_GENTYPES) || defined(GLM_FORCE_ALIGNED_GENTYPES)
#error "gloam's types are packed: compile sources that include gloam without GLM_FORCE_(DEFAULT_)ALIGNED_GENTYPES"
#endif
#ifdef GLM_FORCE_QUAT_DATA_WXYZ
#error "gloam's quaternions are stored x, y, z, w: compile sources that include gloam without GLM_FORCE_QUAT_DATA_WXYZ"
#endif

#ifndef GLM_FORCE_DEPTH_ZERO_TO_ONE
#define GLM_FORCE_DEPTH_ZERO_TO_ONE
#endif

#include <cstdint>
#include <glm/common.hpp>
#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/matrix_float3x3.hpp>
#include <glm/ext/matrix_float4x4.hpp>
#include <glm/ext/quaternion_double.hpp>
#include <glm/ext/quaternion_float.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_double4.hpp>
#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_float4.hpp>
#include <glm/ext/vector_int2.hpp>
#include <glm/ext/vector_uint2.hpp>
#include <glm/ext/vector_uint3.hpp>
#include <glm/ext/vector_uint4.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gloam {

using glm::dmat4;
using glm::dquat;
using glm::dvec3;
using glm::dvec4;
using glm::ivec2;
using glm::mat3;
using glm::mat4;
using glm::quat;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

static_assert(sizeof(vec3) == 12 && alignof(vec3) == 4 && sizeof(dvec3) == 24 && sizeof(mat3) == 36,
              "gloam's types are packed: GLM is configured with aligned types");

inline constexpr float kPi = 3.14159265358979323846f;

}  // namespace gloam
