// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// Samples plain, layered, cube and cube-array views of test images at texel centres.
layout(local_size_x = 1) in;

layout(set = 0, binding = 0) uniform sampler2D plane;
layout(set = 0, binding = 1) uniform sampler2DArray layers;
layout(set = 0, binding = 2) uniform samplerCube cube;
layout(set = 0, binding = 3) uniform samplerCubeArray cubes;
layout(set = 0, binding = 4, scalar) writeonly buffer Seen { vec4 seen[4]; };
layout(push_constant, scalar) uniform Push {
  uvec2 texel;
  uint layer;
}
push;

void main() {
  vec2 at = (vec2(push.texel) + 0.5) / vec2(textureSize(plane, 0));
  seen[0] = textureLod(plane, at, 0.0);
  seen[1] = textureLod(layers, vec3(at, push.layer), 0.0);
  seen[2] = textureLod(cube, vec3(0.0, 0.0, -1.0), 0.0);
  seen[3] = textureLod(cubes, vec4(0.0, 0.0, -1.0, 1.0), 0.0);
}
