// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_DEPTH_OF_FIELD_NEAR_API_GLSL
#define GLOAM_SHADERS_DEPTH_OF_FIELD_NEAR_API_GLSL

// Light multiplied by its coverage, and the coverage: adds what lies behind. Where both would cover more than a pixel,
// what lies behind is hidden.
vec4 under(vec4 front, vec4 behind) { return front + behind * clamp((1.0 - front.a) / max(behind.a, 1e-9), 0.0, 1.0); }

#endif
