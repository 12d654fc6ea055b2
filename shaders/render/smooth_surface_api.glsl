// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_SMOOTH_SURFACE_API_GLSL
#define GLOAM_SHADERS_RENDER_SMOOTH_SURFACE_API_GLSL

// The smooth surface: what the vertex normals of a triangle describe. Seen from a point of the triangle, it lies where
// the planes through the vertices, perpendicular to their normals, are on average (Hanika, "Hacking the Shadow
// Terminator", Ray Tracing Gems II, 2021). Only planes above the point count, so the smooth surface is never below the
// triangle. Unlike there, a triangle that is not convex everywhere gets a normal between that of the face and the
// interpolated one.
//
// Layout of GeometryOutputs::smooth_surfaces, rg32_uint:
//   x  octahedral normal of the smooth surface, as pack_normal
//   y  low half: direction of the offset from the drawn surface to the smooth one, octahedral, 1…255 in each byte;
//      high half: its length in metres, half precision. 0: no smooth surface, the triangle is flat-shaded or concave.

#include "shaders/common/math.glsl"

struct SmoothSurface {
  bool exists;  // false: the other members are undefined
  vec3 offset;  // metres, from the drawn surface
  vec3 normal;  // unit, on the visible side
};

// Sine of the angle between a vertex normal and the plane perpendicular to an edge, below which the triangle counts as
// flat along this edge: several times the rounding error of packed normals.
const float kFlatSine = 2e-4;

uint pack_offset(vec3 offset) {
  float size = length(offset);
  vec2 code = octahedral_encode(size > 1e-20 ? offset / size : vec3(0.0, 0.0, 1.0)) * 127.0 + 128.0;
  return (packHalf2x16(vec2(0.0, min(size, 65504.0))) & 0xFFFF0000u) | uint(code.y + 0.5) << 8 | uint(code.x + 0.5);
}

vec3 unpack_offset(uint packed) {
  vec2 code = (vec2(packed & 0xFFu, packed >> 8 & 0xFFu) - 128.0) / 127.0;
  return octahedral_decode(code) * unpackHalf2x16(packed).y;
}

SmoothSurface decode_smooth_surface(uvec2 texel) {
  return SmoothSurface(texel.y != 0u, unpack_offset(texel.y), unpack_normal(texel.x));
}

// normals: of the vertices. heights: of the point over the three planes, negative below them. share: barycentric
// coordinates.
vec3 smooth_offset(vec3 normals[3], vec3 heights, vec3 share) {
  vec3 up = share * max(-heights, vec3(0.0));
  return up.x * normals[0] + up.y * normals[1] + up.z * normals[2];
}

// How much the smooth surface is above the point rather than below it: 1 convex, 0 concave.
float smooth_share(vec3 heights, vec3 share) {
  float above = dot(share, max(-heights, vec3(0.0))), below = dot(share, max(heights, vec3(0.0)));
  return below > 0.0 ? above / (above + below) : 1.0;
}

#endif
