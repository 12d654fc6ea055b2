// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/smooth_surface_api.glsl"

// Writes the smooth surface of a fragment, if the geometry buffer shows this surface.

layout(set = 0, binding = 4) uniform sampler2D depth_image;
layout(set = 0, binding = 5) uniform usampler2D normal_image;

layout(location = 0) in vec3 in_share;
layout(location = 1) flat in vec3 in_normals[3];
layout(location = 4) flat in vec3 in_heights[3];

layout(location = 0) out uvec4 out_surface;

// Greatest difference between the depth of the same surface here and in the geometry buffer, as a share of it. The two
// passes may round positions differently.
const float kDepthRounding = 1e-4;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(depth_image, pixel, 0).r;
  if (abs(gl_FragCoord.z - depth) > kDepthRounding * depth) discard;
  vec3 share = max(in_share, vec3(0.0));
  vec3 heights = share.x * in_heights[0] + share.y * in_heights[1] + share.z * in_heights[2];
  float convex = smooth_share(heights, share);
  if (convex <= 0.0) discard;
  vec3 face_normal = unpack_normal(texelFetch(normal_image, pixel, 0).y);
  vec3 normal = normalize(share.x * in_normals[0] + share.y * in_normals[1] + share.z * in_normals[2]);
  out_surface = uvec4(pack_normal(mix(face_normal, normal, convex)),
                      pack_offset(smooth_offset(in_normals, heights, share)), 0u, 0u);
}
