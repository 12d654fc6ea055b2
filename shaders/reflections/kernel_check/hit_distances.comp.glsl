// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/reflections/hit_distance_api.glsl"

// Packs distances into an image, or unpacks an image.
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kUnpack = 0u;

layout(set = 0, binding = 0, scalar) readonly buffer Metres { float metres[]; };
layout(set = 0, binding = 1, rgba8) uniform writeonly image2D packed_image;
layout(set = 0, binding = 2) uniform sampler2D stored_image;
layout(set = 0, binding = 3, scalar) writeonly buffer Unpacked { float unpacked[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  ivec2 at = ivec2(i % 256u, i / 256u);
  if (kUnpack != 0u)
    unpacked[i] = unpack_hit_distance(texelFetch(stored_image, at, 0).xy);
  else
    imageStore(packed_image, at, vec4(pack_hit_distance(metres[i]), 0.0, 0.0));
}
