// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// target[i] = source[i] * scale + offset, for the tests of buffers, push constants, uniforms and specialisation.
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kScale = 2;

layout(set = 0, binding = 0, scalar) readonly buffer Source { uint source[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Target { uint target[]; };
layout(set = 0, binding = 2, scalar) uniform Offset { uint offset; }
uniforms;
layout(push_constant, scalar) uniform Push { uint count; }
push;

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < push.count) target[i] = source[i] * kScale + uniforms.offset;
}
