// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/view_shared.h"

// Finds the surfaces that screen space and proxies serve, and lists the tiles that hold one: the later passes run in
// these tiles only. tile_roughness: the greatest roughness of such a surface in each tile, 1…255; 0: there is none.

layout(local_size_x = GLOAM_REFLECTION_GROUP, local_size_y = GLOAM_REFLECTION_GROUP) in;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 2) uniform usampler2D normal_image;
layout(set = 0, binding = 3) uniform sampler2D material_image;
layout(set = 0, binding = 4) uniform sampler2D depth_image;
layout(set = 0, binding = 5, rg32ui) uniform writeonly uimage2D mirror_image;
layout(set = 0, binding = 6, rgba8) uniform writeonly image2D surface_image;  // 0: no reflection
layout(set = 0, binding = 7, scalar) buffer Commands { MirrorCommands mirror_commands; };
layout(set = 0, binding = 8, scalar) buffer Places { uint mirror_tiles[]; };       // x | y << 16, in any order
layout(set = 0, binding = 9, scalar) buffer Roughness { uint tile_roughness[]; };  // of each tile of the image

#include "shaders/reflections/surfaces_api.glsl"

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(uvec2(texel), reflection.size))) return;
  MirrorSurface s = mirror_surface(texel);
  imageStore(mirror_image, texel, uvec4(encode_mirror_surface(s, texel), 0u, 0u));
  imageStore(surface_image, texel, vec4(0.0));
  if (s.share <= 0.0) return;
  uint row = (reflection.size.x + GLOAM_REFLECTION_GROUP - 1u) / GLOAM_REFLECTION_GROUP;
  uint tile = gl_WorkGroupID.y * row + gl_WorkGroupID.x;
  if (atomicMax(tile_roughness[tile], max(uint(s.roughness * 255.0 + 0.5), 1u)) != 0u) return;
  uint index = atomicAdd(mirror_commands.count, 1u);
  mirror_tiles[index] = gl_WorkGroupID.x | gl_WorkGroupID.y << 16;
  atomicMax(mirror_commands.groups_y, index / uint(GLOAM_TILE_ROW) + 1u);
}
