// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/view_shared.h"

// The same as dilate.comp in the listed tiles only, without shared memory: for devices that run the threads of a
// workgroup in turn, where a barrier costs more than it saves.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 2) uniform sampler2D spread_image;
layout(set = 0, binding = 3) uniform sampler2D surface_image;
layout(set = 0, binding = 4, r8) uniform writeonly image2D dilated_image;
layout(set = 0, binding = 5, scalar) readonly buffer Roughness { uint tile_roughness[]; };

#define GLOAM_MIRROR_TILES 6
#include "shaders/reflections/passes/blur_width.glsl"
#include "shaders/reflections/mirror_surface_api.glsl"

// The width of the blur along rows changes slowly with the place: that of this thread's texel stands for its
// neighbours'.
float unit;

// Spread of a texel whose blur reaches `offset` texels far; 0 if it does not.
float spread_from(ivec2 texel, int offset) {
  float roughness = texelFetch(surface_image, texel, 0).y, spread = texelFetch(spread_image, texel, 0).x;
  bool reaches = is_inside(texel) && roughness > 0.0 && offset <= widest_reach(unit * spread * blur_factor(roughness));
  return reaches ? spread : 0.0;
}

// No blur of a texel in this line reaches farther than that of spread 1 and its tile's greatest roughness.
int farthest_reach(ivec2 texel) {
  ivec2 tiles = (ivec2(reflection.size) + GLOAM_REFLECTION_GROUP - 1) / GLOAM_REFLECTION_GROUP;
  ivec2 own = texel / GLOAM_REFLECTION_GROUP;
  int aside = (int(reflection.blur_radius) + GLOAM_REFLECTION_GROUP - 1) / GLOAM_REFLECTION_GROUP, most = 0;
  for (int i = -aside; i <= aside; ++i) {
    ivec2 tile = own + i * kAlong, there = clamp(tile, ivec2(0), tiles - 1);
    float roughness = float(tile_roughness[there.y * tiles.x + there.x]) / 255.0;
    int reach = tile == there ? widest_reach(unit * blur_factor(roughness)) : 0;
    most = reach > (abs(i) - 1) * GLOAM_REFLECTION_GROUP ? max(most, reach) : most;
  }
  return most;
}

void main() {
  ivec2 texel;
  if (!mirror_texel(texel)) return;
  float roughness = texelFetch(surface_image, texel, 0).y, spread = texelFetch(spread_image, texel, 0).x;
  unit = blur_unit(texel);
  int last = roughness > 0.0 ? farthest_reach(texel) : 0;
  int k = 1;
  do {
    spread = max(spread, max(spread_from(texel - k * kAlong, k), spread_from(texel + k * kAlong, k)));
  } while (++k <= last);
  imageStore(dilated_image, texel, vec4(roughness > 0.0 ? spread : 0.0));
}
