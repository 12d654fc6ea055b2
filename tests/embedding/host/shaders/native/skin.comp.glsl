// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// Poses the vertices of a mesh with two bones.

layout(local_size_x = 64) in;

// xyz: position at rest; w: weight of the second bone, 0 to 1.
layout(set = 0, binding = 0, scalar) readonly buffer Rest { vec4 rest[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Bones { mat4 bones[2]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Posed { vec3 posed[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(rest.length())) return;
  vec4 position = vec4(rest[i].xyz, 1.0);
  posed[i] = mix((bones[0] * position).xyz, (bones[1] * position).xyz, rest[i].w);
}
