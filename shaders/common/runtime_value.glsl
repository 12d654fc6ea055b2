// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_COMMON_RUNTIME_VALUE_GLSL
#define GLOAM_SHADERS_COMMON_RUNTIME_VALUE_GLSL

// Compute shaders only. Returns `value`, a member of a uniform block that decides a branch or a number of turns. Mesa
// 22.3's lavapipe compiles a shader anew in every frame with such members as constants, unless the condition also
// depends on a value that it does not know. tests/program/shader_cache_test.py finds shaders that lack this.
uint runtime_value(uint value) { return value + uint(gl_NumWorkGroups.x == 0u); }

#endif
