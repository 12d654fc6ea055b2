// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/math.glsl"
#include "shaders/reflections/recapture/recapture_shared.h"

// A mip of a probe's octahedral map, prefiltered from the faces of a cube: as modules/reflections/bake/probe_map.cpp.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2DArray face_images;
layout(set = 0, binding = 1, scalar) readonly buffer Samples { ProbeSample lobe[]; };
layout(set = 0, binding = 2, rgba16f) uniform writeonly image2D map_image;

layout(push_constant, scalar) uniform Push { ProbeMapConstants map; };

// Light of the cube from a direction. Faces +X, −X, +Y, −Y, +Z, −Z, as cube_face_axes() orients them.
vec3 cube_light(vec3 d, float lod) {
  vec3 size = abs(d);
  float face, x, y, along;
  if (size.x >= size.y && size.x >= size.z) {
    face = d.x > 0.0 ? 0.0 : 1.0, along = size.x, x = d.x > 0.0 ? d.z : -d.z, y = d.y;
  } else if (size.y >= size.z) {
    face = d.y > 0.0 ? 2.0 : 3.0, along = size.y, x = d.y > 0.0 ? d.x : -d.x, y = d.z;
  } else {
    face = d.z > 0.0 ? 4.0 : 5.0, along = size.z, x = d.z > 0.0 ? -d.x : d.x, y = d.y;
  }
  return textureLod(face_images, vec3(0.5 + 0.5 * x / along, 0.5 - 0.5 * y / along, face), lod).rgb;
}

vec3 map_direction(vec2 uv) { return octahedral_decode(2.0 * uv - 1.0).xzy; }

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(map_image);
  if (texel.x >= size.x || texel.y >= size.y) return;
  vec3 sum = vec3(0.0);
  if (map.exact != 0u) {
    for (int i = 0; i < 4; ++i) {
      vec2 at = vec2(texel) + 0.25 + 0.5 * vec2(i & 1, i >> 1);
      sum += 0.25 * cube_light(map_direction(at / vec2(size)), 0.0);
    }
  } else {
    vec3 normal = map_direction((vec2(texel) + 0.5) / vec2(size));
    vec3 helper = abs(normal.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 x = normalize(cross(helper, normal)), y = cross(normal, x);
    for (uint i = 0u; i < map.samples; ++i) {
      ProbeSample s = lobe[i];
      sum += s.weight * cube_light(s.direction.x * x + s.direction.y * y + s.direction.z * normal, s.lod);
    }
  }
  imageStore(map_image, texel, vec4(min(sum, vec3(65504.0)), 1.0));
}
