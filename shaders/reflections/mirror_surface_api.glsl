// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_REFLECTIONS_MIRROR_SURFACE_API_GLSL
#define GLOAM_SHADERS_REFLECTIONS_MIRROR_SURFACE_API_GLSL

#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/view_api.glsl"

// The surface that a texel of the reflection images stands for, as passes/surroundings.comp.glsl stores it. Include
// this after the uniforms `view` and `reflection`.

struct MirrorSurface {
  ivec2 pixel;     // of the view
  float depth;     // reversed Z
  vec3 position;   // camera-relative
  vec3 direction;  // of the ray mirrored at a horizontal plane, unit length
  float share;     // mirror_share(); 0: no such surface, and the other members are undefined
  float roughness;
};

// Sets position and direction from pixel and depth.
void place_mirror_surface(inout MirrorSurface s) {
  s.position = relative_position(view, vec2(s.pixel), max(s.depth, 1e-30));
  vec3 seen = -normalize(to_viewer(view, s.position));
  s.direction = vec3(seen.x, -seen.y, seen.z);
}

// One texel of the image of mirror surfaces (rg32ui): depth, then share, roughness and the pixel's place in its block.
uvec2 encode_mirror_surface(MirrorSurface s, ivec2 texel) {
  ivec2 offset = s.pixel - texel * int(reflection.scale);
  uint share = s.share > 0.0 ? max(uint(s.share * 255.0 + 0.5), 1u) : 0u;
  uint packed = share | uint(s.roughness * 255.0 + 0.5) << 8 | uint(offset.x) << 16 | uint(offset.y) << 17;
  return uvec2(floatBitsToUint(s.depth), packed);
}

// The pixel that a texel stands for.
ivec2 mirror_pixel_of(uvec2 stored, ivec2 texel) {
  return texel * int(reflection.scale) + ivec2(stored.y >> 16 & 1u, stored.y >> 17 & 1u);
}

MirrorSurface decode_mirror_surface(uvec2 stored, ivec2 texel) {
  MirrorSurface s;
  s.pixel = mirror_pixel_of(stored, texel);
  s.depth = uintBitsToFloat(stored.x);
  s.share = float(stored.y & 255u) / 255.0;
  s.roughness = float(stored.y >> 8 & 255u) / 255.0;
  place_mirror_surface(s);
  return s;
}

// For passes over the listed tiles, one workgroup each: define GLOAM_MIRROR_TILES as the first of two bindings.
#ifdef GLOAM_MIRROR_TILES
layout(local_size_x = GLOAM_REFLECTION_GROUP, local_size_y = GLOAM_REFLECTION_GROUP) in;

layout(set = 0, binding = GLOAM_MIRROR_TILES, scalar) readonly buffer Commands { MirrorCommands mirror_commands; };
layout(set = 0, binding = GLOAM_MIRROR_TILES + 1, scalar) readonly buffer Places { uint mirror_tiles[]; };

// This thread's texel. False: there is none for it.
bool mirror_texel(out ivec2 texel) {
  uint index = gl_WorkGroupID.y * uint(GLOAM_TILE_ROW) + gl_WorkGroupID.x;
  uint place = mirror_tiles[min(index, mirror_commands.count - 1u)];
  texel = ivec2(place & 0xFFFFu, place >> 16) * GLOAM_REFLECTION_GROUP + ivec2(gl_LocalInvocationID.xy);
  return index < mirror_commands.count && all(lessThan(uvec2(texel), reflection.size));
}
#endif

#endif
