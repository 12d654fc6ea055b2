// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"

// Finds the pixels of each tile that are drawn as sprites, one thread a tile, in the order of its rows.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1) uniform sampler2D depth_image;
layout(set = 0, binding = 2) uniform sampler2D lit_image;
layout(set = 0, binding = 3, scalar) readonly buffer Bounds { DofTileBounds bounds[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer TileSprites { DofTileSprites tile_sprites[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer Sprites { DofSprite sprites[]; };
layout(set = 0, binding = 6, scalar) buffer Lists { DofList lists[]; };

#include "shaders/depth_of_field/sprites_api.glsl"

ivec2 first;
ivec2 inside(ivec2 pixel) { return min(pixel, ivec2(dof.size) - 1); }

float finite_brightness(ivec2 pixel) {
  vec3 light = texelFetch(lit_image, inside(pixel), 0).rgb;
  return is_finite(light) ? max(brightness(light), 0.0) : 0.0;
}

// From the mean of the fourth roots of a quarter of the pixels: bright pixels hardly raise it. brightest: of all
// pixels.
float surroundings(out float brightest) {
  float roots = 0.0;
  brightest = 0.0;
  int i = 0;
  do {
    ivec2 pixel = first + 2 * ivec2(i & 7, i >> 3);
    float one = finite_brightness(pixel);
    float others = max(finite_brightness(pixel + ivec2(0, 1)), finite_brightness(pixel + ivec2(1, 1)));
    brightest = max(max(brightest, one), max(others, finite_brightness(pixel + ivec2(1, 0))));
    roots += sqrt(sqrt(one));
  } while (++i < 64);
  float mean = roots / 64.0;
  return mean * mean * (mean * mean);
}

// Circles from this radius on are much wider than four pixels.
const float kWideCircle = 5.0;

// Light that sprites take, and, weighted by its brightness, its place in the tile, signed circle and squared place.
struct Bright {
  vec3 light;
  vec4 place;
  float weight;
};
Bright no_light() { return Bright(vec3(0.0), vec4(0.0), 0.0); }
void add(inout Bright sum, Bright other) {
  sum.light += other.light;
  sum.place += other.place;
  sum.weight += other.weight;
}

// Of four pixels.
Bright bright_block(ivec2 corner, float around) {
  vec4 depths = textureGather(depth_image, vec2(corner + 1) * dof.inverse_size);
  Bright sum = no_light();
  for (int j = 0; j < 4; ++j) {
    ivec2 pixel = corner + ivec2(j & 1, j >> 1);
    float depth = j == 0 ? depths.w : j == 1 ? depths.z : j == 2 ? depths.x : depths.y;
    vec3 own = texelFetch(lit_image, inside(pixel), 0).rgb;
    float coc = circle_of_confusion(depth);
    bool counts = all(lessThan(uvec2(pixel), dof.size)) && is_finite(own);
    float share = counts ? sprite_share(own, coc, around) : 0.0;
    vec3 taken = share > 0.0 ? share * own : vec3(0.0);
    vec2 place = vec2(pixel - first);
    add(sum, Bright(taken, brightness(taken) * vec4(place, coc, dot(place, place)), brightness(taken)));
  }
  return sum;
}

uint count;  // sprites of the tile
void append(uint tile, Bright found) {
  if (found.weight <= 0.0) return;
  vec4 place = found.place / found.weight;
  // A row of w pixels has a variance of (w² − 1) / 12.
  float variance = max(0.5 * (place.w - dot(place.xy, place.xy)), 0.0);
  float soft = min(sqrt(12.0 * variance + 1.0), max(abs(place.z), 1.0));
  if (count < uint(GLOAM_DOF_TILE_SPRITES))
    sprites[tile * uint(GLOAM_DOF_TILE_SPRITES) + count] =
        DofSprite(vec2(first) + place.xy, place.z, soft, found.light);
  ++count;
}

void main() {
  uvec2 tile = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(tile, dof.tiles))) return;
  uint index = tile.y * dof.tiles.x + tile.x;
  first = ivec2(tile) * GLOAM_DOF_TILE;
  // Level 0 blurs pixels one by one, so there sprites change nothing.
  bool blurred = (bounds[index].far | bounds[index].near) > 1u;
  float around = -1.0, brightest = 0.0;
  if (blurred) around = surroundings(brightest);
  // Few tiles have a pixel that sprite_share() can choose.
  bool has_bright = blurred && brightest > 40.0 * around;
  count = 0u;
  for (int i = 0; i < (has_bright ? 16 : 0); ++i) {
    ivec2 corner = first + 4 * ivec2(i & 3, i >> 2);
    Bright wide = no_light();
    for (int j = 0; j < 4; ++j) {
      Bright found = bright_block(corner + 2 * ivec2(j & 1, j >> 1), around);
      // The circles of these pixels hide that the light comes from one place.
      bool is_wide = abs(found.place.z) >= kWideCircle * found.weight;
      append(index, is_wide ? no_light() : found);
      add(wide, is_wide ? found : no_light());
    }
    append(index, wide);
  }
  bool overflows = count > uint(GLOAM_DOF_TILE_SPRITES);
  tile_sprites[index] = DofTileSprites(overflows ? 0u : count, overflows || count == 0u ? -1.0 : around);
  if (overflows) atomicAdd(lists[GLOAM_DOF_OVERFLOW].count, 1u);
  if (!overflows && count > 0u) atomicAdd(lists[GLOAM_DOF_SPRITES].count, count);
}
