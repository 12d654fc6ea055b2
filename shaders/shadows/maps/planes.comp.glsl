// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shadows/maps/planes_shared.h"

// Makes planes, which bound the depths of blocks of shadow maps from above (planes_shared.h). Each thread makes one
// texel of level 0, or one texel of the last level together with those of the levels between.

layout(local_size_x = GLOAM_SHADOW_PLANE_GROUP, local_size_y = GLOAM_SHADOW_PLANE_GROUP) in;

layout(set = 0, binding = 0) uniform sampler2D atlas;
layout(set = 0, binding = 1, rgba32f) uniform image2D planes;
layout(set = 0, binding = 2, scalar) readonly buffer Groups { ShadowPlaneGroup groups[]; };
layout(push_constant, scalar) uniform Constants { ShadowPlaneConstants run; };

// Which levels the pipeline makes: a processor goes through the code of both. 0: as pushed; 1: level 0; 2: the others.
layout(constant_id = 0) const uint kLevels = 0u;

ShadowPlaneGroup stretch;  // this workgroup's entry

const int kBlock = GLOAM_SHADOW_PLANE_BLOCK;

ivec2 level_corner(int level) {
  int size = int(run.atlas_size) / kBlock;
  return level == 0 ? ivec2(0) : ivec2(size, size - (2 * size >> level));
}

// Four texels of the atlas in the order (0,1), (1,1), (1,0), (0,0).
vec4 quad_depths(ivec2 texel) {
  return textureGather(atlas, vec2(texel + 1) / (vec2(1.5, 1.0) * float(run.atlas_size)));
}

float greatest(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }
float least(vec4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }

// The plane of a block of level 0: slopes by least squares, raised until no depth is above it.
vec4 plane_of_block(ivec2 corner) {
  const vec4 right = vec4(-0.5, 0.5, 0.5, -0.5), down = vec4(0.5, 0.5, -0.5, -0.5);
  vec2 moments = vec2(0.0);
  float nearest = 0.0, farthest = 1.0;
  for (int i = 0; i < 16; ++i) {
    ivec2 quad = 2 * ivec2(i & 3, i >> 2);
    vec4 depth = quad_depths(corner + quad);
    vec2 middle = vec2(quad) + 1.0 - 0.5 * float(kBlock);
    moments += vec2(dot(depth, middle.x + right), dot(depth, middle.y + down));
    nearest = max(nearest, greatest(depth));
    farthest = min(farthest, least(depth));
  }
  // Σ (x − mean)² over eight columns is 42, so over eight rows of them it is 336.
  vec2 slope = farthest > 0.0 ? moments / 336.0 : vec2(0.0);
  float height = -1e30;
  for (int i = 0; i < 16; ++i) {
    ivec2 quad = 2 * ivec2(i & 3, i >> 2);
    vec2 middle = vec2(quad) + 1.0 - 0.5 * float(kBlock);
    height =
        max(height, greatest(quad_depths(corner + quad) - slope.x * (middle.x + right) - slope.y * (middle.y + down)));
  }
  return vec4(height, slope, nearest);
}

// Four planes of a level, two by two, that become one of the next level.
struct Merge {
  vec4 children[4];
};

vec4 merged(Merge m, float child_texels) {
  vec2 slope = 0.25 * (m.children[0].yz + m.children[1].yz + m.children[2].yz + m.children[3].yz);
  float height = -1e30, nearest = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec4 child = m.children[i];
    vec2 middle = child_texels * (vec2(i & 1, i >> 1) - 0.5);
    vec2 steeper = abs(child.yz - slope);
    float above = child.x - dot(slope, middle) + (steeper.x + steeper.y) * 0.5 * (child_texels - 1.0);
    height = child.w > 0.0 ? max(height, above) : height;
    nearest = max(nearest, child.w);
  }
  return vec4(nearest > 0.0 ? height : 0.0, nearest > 0.0 ? slope : vec2(0.0), nearest);
}

ivec2 level_texel(int level, ivec2 in_face) {
  return level_corner(level) + (ivec2(stretch.origin) / kBlock >> level) + in_face;
}

// Whether the texel of this level is inside the face.
bool in_face(int level, ivec2 texel) { return all(lessThan(texel, ivec2(stretch.size / uint(kBlock) >> level))); }

void store(int level, ivec2 texel, vec4 plane) {
  if (in_face(level, texel)) imageStore(planes, level_texel(level, texel), plane);
}

vec4 load(ivec2 texel) { return in_face(0, texel) ? imageLoad(planes, level_texel(0, texel)) : vec4(0.0); }

void make_levels(ivec2 at) {
  Merge third;
  for (int a = 0; a < 4; ++a) {
    ivec2 at2 = at * 2 + ivec2(a & 1, a >> 1);
    Merge second;
    for (int b = 0; b < 4; ++b) {
      ivec2 at1 = at2 * 2 + ivec2(b & 1, b >> 1);
      Merge first;
      for (int c = 0; c < 4; ++c) first.children[c] = load(at1 * 2 + ivec2(c & 1, c >> 1));
      second.children[b] = merged(first, float(kBlock));
      store(1, at1, second.children[b]);
    }
    third.children[a] = merged(second, float(2 * kBlock));
    store(2, at2, third.children[a]);
  }
  store(3, at, merged(third, float(4 * kBlock)));
}

void main() {
  stretch = groups[run.first_group + gl_WorkGroupID.x];
  uvec2 at = stretch.begin + gl_LocalInvocationID.xy;
  if (any(greaterThanEqual(at, stretch.end))) return;
  ivec2 texel = ivec2(at);
  if (kLevels == 1u || (kLevels == 0u && run.first_level == 0u))
    store(0, texel, plane_of_block(ivec2(stretch.origin) + texel * kBlock));
  if (kLevels == 2u || (kLevels == 0u && run.first_level != 0u)) make_levels(texel);
}
