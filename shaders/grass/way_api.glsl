// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_GRASS_WAY_API_GLSL
#define GLOAM_SHADERS_GRASS_WAY_API_GLSL

// The way of a knot from frame to frame, in the fourth components of its position and its previous one: x and y as half
// floats, and z. Halves below infinity never make a NaN of the pair. way: shorter than 65504 m.

vec2 pack_way(vec3 way) { return vec2(uintBitsToFloat(packHalf2x16(way.xy)), way.z); }

vec3 unpack_way(vec2 stored) { return vec3(unpackHalf2x16(floatBitsToUint(stored.x)), stored.y); }

#endif
