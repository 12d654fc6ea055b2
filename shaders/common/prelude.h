// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_COMMON_PRELUDE_H
#define GLOAM_SHADERS_COMMON_PRELUDE_H

// Lets one header declare structs for C++ and for GLSL. Structs use scalar block layout, which is how C++ lays out
// plain floats, vectors and column-major matrices.

#ifdef __cplusplus
#include "shaders/common/vectors.h"
#define GLOAM_SHARED_BEGIN namespace gloam::shaders {
#define GLOAM_SHARED_END }
namespace gloam::shaders {
using uint = std::uint32_t;
using glm::ivec2;
}  // namespace gloam::shaders
#else
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#define GLOAM_SHARED_BEGIN
#define GLOAM_SHARED_END
#endif

#endif
