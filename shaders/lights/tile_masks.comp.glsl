// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lights/lights_shared.h"
#include "shaders/render/view_api.glsl"

// Which lights may touch the opaque surfaces of each shadow tile of 8×8 pixels: 1024 bits in 32 layers, and in one more layer which
// of those words are not empty (the others are not written). One workgroup is a tile group of 8×8 tiles: it first finds the lights
// of the group, then each thread those of its tile. Lights are only left out when they certainly do not touch the bounds.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Lights { LightBlock lights; };
layout(set = 0, binding = 2) uniform sampler2D depth_bounds;
layout(set = 0, binding = 3, r32ui) uniform writeonly uimage2DArray masks;

shared uint group_near;  // bits of non-negative floats order as the floats do
shared uint group_far;
shared uint group_words[GLOAM_LIGHT_GROUPS];

struct Box {
  vec3 center;
  vec3 half_extent;
};

// Camera-relative box around the part of a pixel rectangle between two depths, widened by 1/1000 against rounding.
Box froxel(vec2 first, vec2 last, float nearest, float farthest) {
  vec3 low = vec3(1e30), high = vec3(-1e30);
  for (int i = 0; i < 8; ++i) {
    vec2 corner = vec2((i & 1) != 0 ? last.x : first.x, (i & 2) != 0 ? last.y : first.y) - 0.5;
    vec3 p = relative_position(view, corner, (i & 4) != 0 ? nearest : farthest);
    low = min(low, p);
    high = max(high, p);
  }
  Box box = Box((low + high) * 0.5, (high - low) * 0.5);
  box.half_extent += 1e-3 * (box.half_extent + abs(box.center)) + 1e-4;
  return box;
}

bool touches(LocalLight light, Box box) {
  vec3 outside = max(abs(light.position - box.center) - box.half_extent, vec3(0.0));
  if (dot(outside, outside) * light.inverse_range_squared > 1.00001) return false;  // rounding of far lights
  if (light.spot_scale == 0.0) return true;
  // Cone against the box's sphere (Wronski 2017, "Cull that cone!"). Shading knows the cosine to a few 1e-7 only: the cone is
  // widened by more; and a cross product keeps the digits that the difference of two large squares would lose.
  float cos_outer = -light.spot_offset / light.spot_scale - 1e-6;
  float sin_outer = sqrt(max(1.0 - cos_outer * cos_outer, 0.0));
  float radius = length(box.half_extent);
  vec3 v = box.center - light.position;
  float along = dot(v, light.direction);
  float across = length(cross(v, light.direction));
  return cos_outer * across - along * sin_outer <= radius * 1.001 && along >= -radius - 1e-6 * across;
}

void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  ivec2 tiles = textureSize(depth_bounds, 0);
  bool inside = all(lessThan(tile, tiles));
  uint lane = gl_LocalInvocationIndex;
  if (lane < GLOAM_LIGHT_GROUPS) group_words[lane] = 0u;
  if (lane == 0u) {
    group_near = 0u;
    group_far = 0x7F800000u;
  }
  barrier();
  vec2 bounds = texelFetch(depth_bounds, min(tile, tiles - 1), 0).xy;
  bool occupied = inside && bounds.y > 0.0;
  if (occupied) {
    atomicMax(group_near, floatBitsToUint(bounds.y));
    atomicMin(group_far, floatBitsToUint(bounds.x));
  }
  barrier();
  if (group_near > 0u) {
    vec2 first = vec2(gl_WorkGroupID.xy * 64u);
    Box box = froxel(first, min(first + 64.0, vec2(view.size)), uintBitsToFloat(group_near), uintBitsToFloat(group_far));
    for (uint i = lane; i < lights.local_count; i += 64u)
      if (touches(lights.local[i], box)) atomicOr(group_words[i >> 5], 1u << (i & 31u));
  }
  barrier();
  if (!inside) return;
  uint groups = 0u;
  if (occupied) {
    vec2 first = vec2(tile * 8);
    Box box = froxel(first, min(first + 8.0, vec2(view.size)), bounds.y, bounds.x);
    for (uint word = 0u; word * 32u < lights.local_count; ++word) {
      uint mask = 0u;
      for (uint left = group_words[word]; left != 0u; left &= left - 1u) {
        uint bit = uint(findLSB(left));
        if (touches(lights.local[word * 32u + bit], box)) mask |= 1u << bit;
      }
      if (mask == 0u) continue;
      groups |= 1u << word;
      imageStore(masks, ivec3(tile, word), uvec4(mask));
    }
  }
  imageStore(masks, ivec3(tile, GLOAM_LIGHT_GROUPS), uvec4(groups));
}
