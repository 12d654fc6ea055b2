// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_SCATTERED_LIGHT_API_GLSL
#define GLOAM_SHADERS_LIGHTING_SCATTERED_LIGHT_API_GLSL

// The light that a picture shows where a share of it is scattered by the lens (ScatteredLight of
// modules/lighting/outputs.h). scattered: the picture's spread light at the pixel, before the share.
vec3 with_scattered_light(vec3 light, vec3 scattered, float share) { return light * (1.0 - share) + scattered * share; }

#endif
