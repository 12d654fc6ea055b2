// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_DEPTH_OF_FIELD_LEVELS_API_GLSL
#define GLOAM_SHADERS_DEPTH_OF_FIELD_LEVELS_API_GLSL

#include "shaders/depth_of_field/depth_of_field_shared.h"

// Texels of a level in the image of all levels. Include this after the uniform `dof`.

ivec2 level_size(int level) { return (ivec2(dof.size) + (1 << level) - 1) >> level; }
ivec2 inside_level(ivec2 texel, ivec2 size) { return clamp(texel, ivec2(0), size - 1); }

#endif
