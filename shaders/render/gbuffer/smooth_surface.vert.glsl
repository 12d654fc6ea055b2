// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/smooth_surface_api.glsl"
#include "shaders/render/gbuffer/smooth_surface_shared.h"
#include "shaders/render/view_api.glsl"

// Gives every fragment the three vertices of its triangle. It fetches indices and vertices itself, because a vertex of
// an indexed draw does not know its triangle.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) readonly buffer Indices { uint mesh_indices[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Positions { float mesh_positions[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Frames { uvec2 mesh_frames[]; };
layout(push_constant, scalar) uniform DrawBlock { SmoothSurfaceConstants constants; };

layout(location = 0) out vec3 out_share;            // barycentric coordinates
layout(location = 1) flat out vec3 out_normals[3];  // of the vertices, on the visible side
layout(location = 4) flat out vec3 out_heights[3];  // [j][i]: height of vertex j over the plane of vertex i

vec3 turned(vec3 v) {
  return vec3(dot(constants.draw.row0.xyz, v), dot(constants.draw.row1.xyz, v), dot(constants.draw.row2.xyz, v));
}

// As in surface.glsl.
vec3 turned_normal(vec3 normal) {
  vec3 c0 = cross(constants.draw.row1.xyz, constants.draw.row2.xyz);
  vec3 c1 = cross(constants.draw.row2.xyz, constants.draw.row0.xyz);
  vec3 c2 = cross(constants.draw.row0.xyz, constants.draw.row1.xyz);
  return normalize(vec3(dot(c0, normal), dot(c1, normal), dot(c2, normal)));
}

vec3 fetch_position(uint vertex) {
  return vec3(mesh_positions[3u * vertex], mesh_positions[3u * vertex + 1u], mesh_positions[3u * vertex + 2u]);
}

void main() {
  uint corner = uint(gl_VertexIndex) % 3u, first = constants.first_index + uint(gl_VertexIndex) - corner;
  vec3 positions[3], normals[3];
  for (int i = 0; i < 3; ++i) {
    uint vertex = mesh_indices[first + uint(i)];
    positions[i] = fetch_position(vertex);
    normals[i] = turned_normal(unpack_normal(mesh_frames[vertex].x));
  }
  vec3 at = positions[corner];
  vec3 relative = turned(at) + vec3(constants.draw.row0.w, constants.draw.row1.w, constants.draw.row2.w);
  vec3 face = cross(turned(positions[1] - positions[0]), turned(positions[2] - positions[0]));
  // The cofactors of a mirroring matrix reverse normals, and its front faces are clockwise: both signs cancel out.
  float side = dot(face, to_viewer(view, relative)) < 0.0 ? -1.0 : 1.0;
  face *= side;
  bool smooth_shaded = false, proper = true;
  for (int i = 0; i < 3; ++i) {
    out_normals[i] = side * normals[i];
    proper = proper && dot(face, out_normals[i]) > 0.0;
    for (int j = 0; j < 3; ++j) {
      vec3 edge = turned(positions[j] - positions[i]);
      float height = dot(edge, out_normals[i]);
      bool flat_edge = abs(height) <= kFlatSine * length(edge);
      out_heights[j][i] = flat_edge ? 0.0 : height;
      smooth_shaded = smooth_shaded || !flat_edge;
    }
  }
  out_share = vec3(equal(uvec3(corner), uvec3(0u, 1u, 2u)));
  gl_Position = view.clip_from_relative * vec4(relative, 1.0);
  // Triangles without a smooth surface are moved out of the picture.
  if (!smooth_shaded || !proper) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
