// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/closeups/closeup_views_api.glsl"
#include "shaders/common/heat.glsl"

// Visualizer of the texels of close-up maps per pixel side on the visible surface: the square root of the number of
// texels that the pixel covers. Where pairs overlap, the finest map counts.

layout(set = 0, binding = 3) uniform usampler2D normals;

const float kOctave = 0.1;   // part of the colour scale per doubling of texels
const float kMost = 6e4;     // limit of the half floats of the named image
const float kEdgeOn = 1e-4;  // lower limit of the sine between surface and view ray

// The surface that a pixel sees: camera-relative position in metres, and the offsets to the next pixel right and down.
struct Footprint {
  vec3 position;
  vec3 right;
  vec3 down;
};

Footprint footprint_of(uvec2 pixel, float depth) {
  vec3 normal = unpack_normal(texelFetch(normals, ivec2(pixel), 0).y);
  vec3 position = relative_position(view, vec2(pixel), depth);
  vec3 along = view.orthographic != 0u ? view.ray_forward.xyz : position;
  float scale = view.orthographic != 0u ? 1.0 : view.ray_base.w / depth;
  float facing = dot(normal, along), least = kEdgeOn * length(along);
  if (abs(facing) < least) facing = facing < 0.0 ? -least : least;
  vec3 dx = view.ray_dx.xyz * scale, dy = view.ray_dy.xyz * scale;
  return Footprint(position, dx - along * (dot(normal, dx) / facing), dy - along * (dot(normal, dy) / facing));
}

vec3 in_face(ShownCloseup c, vec3 v) { return vec3(dot(c.right, v), dot(c.up, v), dot(c.forward, v)); }

// Texels per pixel side; negative outside the pair's frustum.
float texels_of(ShownCloseup c, Footprint f) {
  vec3 at = in_face(c, f.position - c.origin);
  bool perspective = c.tan_half > 0.0;
  float half_width = perspective ? at.z * c.tan_half : c.half_extent_m;
  if (at.z < c.near_m || at.z > c.far_m || max(abs(at.x), abs(at.y)) > half_width) return -1.0;
  vec2 tangent = perspective ? at.xy / at.z : vec2(0.0);
  vec3 right = in_face(c, f.right), down = in_face(c, f.down);
  float scale = 0.5 * c.size / half_width;
  return scale * sqrt(abs(determinant(mat2(right.xy - tangent * right.z, down.xy - tangent * down.z))));
}

void main() {
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  float depth = texelFetch(depth_image, ivec2(pixel), 0).x, texels = -1.0;
  if (depth > 0.0) {
    Footprint footprint = footprint_of(pixel, depth);
    for (uint i = 0u; i < closeup_count; ++i)
      if (in_tiles(closeups[i], pixel)) texels = max(texels, texels_of(closeups[i], footprint));
  }
  show(texels < 0.0 ? vec3(0.0) : heat_color(0.5 + kOctave * log2(max(texels, 1e-9))), texels < 0.0 ? kDarkened : 0.85);
  out_named = vec4(min(texels, kMost), 0.0, 0.0, 1.0);
}
