// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/closeups/closeup_views_api.glsl"
#include "shaders/common/heat.glsl"

// Texels of close-up maps that a pixel's side covers on its surface: the root of those that the pixel covers. Where
// pairs overlap, of the finest map.

layout(set = 0, binding = 3) uniform usampler2D normals;

const float kOctave = 0.1;   // of the colours, to twice as many texels
const float kMost = 6e4;     // that the image of the view's name can hold
const float kEdgeOn = 1e-4;  // sine: surfaces count as seen from no flatter than this

// A surface around the middle of a pixel: camera-relative metres, and a pixel to the right and down.
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

// Negative: outside the pair's frustum.
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
  show(texels < 0.0 ? vec3(0.0) : heat(0.5 + kOctave * log2(max(texels, 1e-9))), texels < 0.0 ? kDarkened : 0.85);
  out_named = vec4(min(texels, kMost), 0.0, 0.0, 1.0);
}
