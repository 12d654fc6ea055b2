// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// Contains every kind of declaration that shader reflection reads.
layout(local_size_x = 4, local_size_y = 2, local_size_z = 3) in;

struct Light {
  vec3 position;
  float range_m;
  mat3 turn;
  uint kind;
};

layout(set = 0, binding = 0, scalar) readonly buffer Lights {
  uint light_count;
  Light lights[];
};
layout(set = 0, binding = 1, scalar) uniform View {
  mat4 clip_from_world;
  vec2 sizes[3];
  float near_m;
}
view;
layout(set = 0, binding = 2) uniform sampler2DShadow shadow;
layout(set = 0, binding = 5) uniform samplerCubeArray probes[4];
layout(set = 0, binding = 6, scalar) buffer Unused { uint unused[]; };
layout(set = 2, binding = 1, rgba16f) writeonly uniform image2DArray target;
layout(push_constant, scalar) uniform Push {
  vec3 eye;
  uint first;
}
push;

void main() {
  Light light = lights[push.first];
  vec4 p = view.clip_from_world * vec4(light.turn * light.position + push.eye, view.sizes[1].x);
  float lit = textureLod(shadow, p.xyz, 0.0) + textureLod(probes[2], p, view.near_m).x;
  imageStore(target, ivec3(gl_GlobalInvocationID), vec4(lit * light.range_m));
}
