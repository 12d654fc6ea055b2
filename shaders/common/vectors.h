// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

// C++ only: the types of GLSL, for structs that C++ and shaders share and for the engine (engine/math/types.h).

// The library is compiled with GLM's packed types. These settings change their layout.
#if defined(GLM_FORCE_DEFAULT_ALIGNED_GENTYPES) || defined(GLM_FORCE_ALIGNED_GENTYPES)
#error "gloam's types are packed: compile sources that include gloam without GLM_FORCE_(DEFAULT_)ALIGNED_GENTYPES"
#endif

// GLM's clip-space settings (GLM_FORCE_DEPTH_ZERO_TO_ONE, GLM_FORCE_LEFT_HANDED) are the host's: nothing here, and
// nothing in the library, calls a function that depends on them.

#include <cstdint>
#include <glm/ext/matrix_float3x3.hpp>
#include <glm/ext/matrix_float4x4.hpp>
#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_float4.hpp>
#include <glm/ext/vector_int2.hpp>
#include <glm/ext/vector_uint2.hpp>
#include <glm/ext/vector_uint3.hpp>
#include <glm/ext/vector_uint4.hpp>

namespace gloam {

using glm::ivec2;
using glm::mat3;
using glm::mat4;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

static_assert(sizeof(vec3) == 12 && alignof(vec3) == 4 && sizeof(mat3) == 36,
              "gloam's types are packed: GLM is configured with aligned types");

}  // namespace gloam
