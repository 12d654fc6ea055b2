// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/math.glsl"
#include "shaders/render/deform_shared.h"

// Morphs, then skins the vertices of one primitive. Skinned vertices are relative to the origin of the instance's joint
// range, others stay in the mesh's space.

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform DeformBlock { DeformConstants c; };
layout(set = 0, binding = 0, scalar) readonly buffer RestPositions { float rest_positions[]; };
layout(set = 0, binding = 1, scalar) readonly buffer RestFrames { uvec2 rest_frames[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Influences {
  uvec4 influences[];
};  // four joints of 16 bits, four unorm16 weights
layout(set = 0, binding = 3, scalar) readonly buffer MorphOffsets { float morph_offsets[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Joints { vec4 joint_rows[]; };  // three rows per joint
layout(set = 0, binding = 5, scalar) readonly buffer Weights { float morph_weights[]; };
layout(set = 0, binding = 6, scalar) writeonly buffer Positions { float positions[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer Frames { uvec2 frames[]; };

vec3 morph_offset(uint plane, uint vertex) {
  uint at = (plane * c.vertex_count + vertex) * 3u;
  return vec3(morph_offsets[at], morph_offsets[at + 1u], morph_offsets[at + 2u]);
}

void main() {
  uint v = gl_GlobalInvocationID.x;
  if (v >= c.vertex_count) return;
  vec3 position = vec3(rest_positions[3u * v], rest_positions[3u * v + 1u], rest_positions[3u * v + 2u]);
  uvec2 frame = rest_frames[v];
  vec3 normal = unpack_normal(frame.x);
  vec3 tangent = unpack_normal(frame.y & 0xFFFEFFFFu);
  uint handedness = frame.y & 0x10000u;

  uint planes = c.morph_has_normals != 0u ? 2u : 1u;
  for (uint target = 0u; target < c.morph_targets; ++target) {
    float weight = morph_weights[c.first_weight + target];
    position += weight * morph_offset(target * planes, v);
    if (planes == 2u) normal += weight * morph_offset(target * planes + 1u, v);
  }

  if (c.skinned != 0u) {
    uvec4 packed = influences[v];
    uvec4 joints = uvec4(packed.x & 0xFFFFu, packed.x >> 16, packed.y & 0xFFFFu, packed.y >> 16);
    vec4 weights = vec4(unpackUnorm2x16(packed.z), unpackUnorm2x16(packed.w));
    vec4 row0 = vec4(0.0), row1 = vec4(0.0), row2 = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
      uint at = 3u * (c.first_joint + joints[i]);
      row0 += weights[i] * joint_rows[at];
      row1 += weights[i] * joint_rows[at + 1u];
      row2 += weights[i] * joint_rows[at + 2u];
    }
    vec4 p = vec4(position, 1.0);
    position = vec3(dot(row0, p), dot(row1, p), dot(row2, p));
    vec3 c0 = cross(row1.xyz, row2.xyz), c1 = cross(row2.xyz, row0.xyz), c2 = cross(row0.xyz, row1.xyz);
    // A mirroring matrix flips the sign of the cofactors.
    float side = dot(row0.xyz, c0) < 0.0 ? -1.0 : 1.0;
    normal = side * vec3(dot(c0, normal), dot(c1, normal), dot(c2, normal));
    tangent = vec3(dot(row0.xyz, tangent), dot(row1.xyz, tangent), dot(row2.xyz, tangent));
    if (side < 0.0) handedness ^= 0x10000u;
  }
  normal = dot(normal, normal) > 0.0 ? normalize(normal) : vec3(0.0, 1.0, 0.0);
  tangent = dot(tangent, tangent) > 0.0 ? normalize(tangent) : vec3(1.0, 0.0, 0.0);
  positions[3u * v] = position.x;
  positions[3u * v + 1u] = position.y;
  positions[3u * v + 2u] = position.z;
  frames[v] = uvec2(pack_normal(normal), (pack_normal(tangent) & 0xFFFEFFFFu) | handedness);
}
