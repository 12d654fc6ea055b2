// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"
#include "shaders/depth_of_field/kernel_api.glsl"

// Makes the texels of one level of a tile from the light.
//
// Far: light of the pixels behind the focus, and in alpha the radius of their kernel. If
// there are none, the light of the pixels in focus and alpha 0, or kBeside if other pixels of the texel are before the
// focus; if there are none of these either, that of the pixels before the focus, or kNothing. Near: light of the pixels
// before the focus that this level blurs, multiplied by their share in the texel, and in alpha the share and the radius
// of their kernel (packed_near()). Light that is not finite counts as absent, and sprites take theirs.

layout(local_size_x_id = 2) in;
layout(constant_id = 1) const uint kMore = 0u;  // 1: tiles with sprites or pixels before the focus
layout(constant_id = 2) const int kThreads = GLOAM_DOF_THREADS;
layout(constant_id = 3) const uint kFine = 0u;  // 1: level 0

layout(push_constant, scalar) uniform Level { DofLevel pushed; };

layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1) uniform sampler2D depth_image;
layout(set = 0, binding = 2) uniform sampler2D lit_image;
layout(set = 0, binding = 3, scalar) readonly buffer TileSprites { DofTileSprites tile_sprites[]; };
layout(set = 0, binding = 4, rgba16f) uniform writeonly image2D far_image;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D near_image;

#define GLOAM_DOF_LIST_BINDING 6
#include "shaders/depth_of_field/blur/layer.glsl"
#include "shaders/depth_of_field/levels_api.glsl"
#include "shaders/depth_of_field/list_api.glsl"
#include "shaders/depth_of_field/sprites_api.glsl"

float around;  // surroundings of the tile's sprites
int level;
LevelRange range;
float
    least;  // circles behind the focus that are much smaller than a texel count as in focus: they would spread too far
bool has_near;
vec3 far_light, focus_light;
float far_weight, far_circle, far_bright, focus_weight, near_circle, before_circle;
vec4 near, before_focus;  // that this level blurs, and all

void clear() {
  far_light = focus_light = vec3(0.0);
  near = before_focus = vec4(0.0);
  far_weight = far_circle = far_bright = focus_weight = near_circle = before_circle = 0.0;
}

void add(ivec2 pixel, float depth) {
  vec3 light = texelFetch(lit_image, min(pixel, ivec2(dof.size) - 1), 0).rgb;
  float counts = is_finite(light) ? 1.0 : 0.0;
  float coc = circle_of_confusion(depth), circle = abs(coc);
  light = counts > 0.0 ? light : vec3(0.0);
  if (kMore != 0u) light *= 1.0 - sprite_share(light, coc, around);
  // Light counts by its area. Circles that are hardly blurred count less.
  float far = coc >= least ? counts * min(coc, 1.0) : 0.0;
  far_light += far * light;
  far_weight += far;
  // The texel has the circle of its brightest pixels: a lamp before a wall keeps its own.
  float bright = far * (brightness(light) + 1e-4);
  far_bright += bright;
  far_circle += bright * coc;
  float focused = coc > -kInFocus && coc < least ? counts : 0.0;
  focus_light += focused * light;
  focus_weight += focused;
  if (kMore != 0u) {
    float before = coc <= -kInFocus ? counts : 0.0;
    before_focus += before * vec4(light, 1.0);
    before_circle = max(before_circle, -coc);
    float part = has_near ? before * level_share(range, circle / GLOAM_DOF_NEAR_FINER) : 0.0;
    near += part * vec4(light, 1.0);
    near_circle += part * circle;
  }
}

void store(ivec2 texel, float pixels, int wanted) {
  ivec2 size = level_size(level);
  if (any(greaterThanEqual(texel, size))) return;
  ivec2 at = dof.corner[level] + texel;
  float greatest = level == dof.last_level ? dof.radius : dof.to[level];
  vec4 far = vec4(0.0, 0.0, 0.0, kNothing);
  if (before_focus.a > 0.0) far = vec4(before_focus.rgb / before_focus.a, kNothing - before_circle);
  if (focus_weight > 0.0) far = vec4(focus_light / focus_weight, before_circle >= kInFocus ? kBeside : 0.0);
  if (far_weight > 0.0)
    far = vec4(far_light / far_weight, rounded_radius(kernel_radius(min(far_circle / far_bright, greatest), level)));
  if ((wanted & GLOAM_DOF_WANTS_FAR) != 0) imageStore(far_image, at, min(far, vec4(65504.0)));
  if ((wanted & GLOAM_DOF_WANTS_NEAR) == 0) return;
  float circle = near.a > 0.0 ? near_circle / near.a : 0.0;
  float share = near.a / pixels;
  vec3 light = near.a > 0.0 ? near.rgb / near.a * rounded_share(share) : vec3(0.0);
  imageStore(near_image, at, vec4(min(light, vec3(65504.0)), packed_near(share, kernel_radius(circle, level))));
}

// Four pixels whose depths are gathered.
void add_block(ivec2 corner, bool fine, int wanted) {
  vec4 depths = textureGather(depth_image, vec2(corner + 1) * dof.inverse_size);
  for (int i = 0; i < 4; ++i) {
    ivec2 pixel = corner + ivec2(i & 1, i >> 1);
    float depth = i == 0 ? depths.w : i == 1 ? depths.z : i == 2 ? depths.x : depths.y;
    if (fine) clear();
    add(pixel, depth);
    if (fine) store(pixel, 1.0, wanted);
  }
}

void main() {
  level = kFine != 0u ? 0 : pushed.level;
  // Tiles of few texels share a workgroup.
  int side = GLOAM_DOF_TILE >> level, items = kFine != 0u ? 64 : side * side;
  int number = int(gl_LocalInvocationIndex), slot = number / items, tiles = dof.prefilter_tiles[level];
  uint list = uint(level + (kMore != 0u ? GLOAM_DOF_PREFILTER_MORE : GLOAM_DOF_PREFILTER));
  DofTile tile;
  if (!listed_tile(list, list_group() * uint(tiles) + uint(slot), tile)) return;
  around = kMore != 0u ? tile_sprites[uint(tile.place.y) * dof.tiles.x + uint(tile.place.x)].surroundings : -1.0;
  int wanted = tile.work;
  range = level_range(level);
  least = level == dof.first_level ? kInFocus : max(0.5 * dof.from[max(level - 1, 0)], kInFocus);
  has_near = (wanted & GLOAM_DOF_HAS_NEAR) != 0;
  ivec2 first = tile.place * GLOAM_DOF_TILE;
  // Tiles that only lie beside circles before the focus.
  bool reads = wanted != GLOAM_DOF_WANTS_NEAR;
  if (kFine != 0u) {
    for (int block = number; block < items; block += kThreads) {
      ivec2 pixel = first + 2 * ivec2(block & 7, block >> 3);
      if (reads) {
        add_block(pixel, true, wanted);
      } else {
        clear();
        for (int i = 0; i < 4; ++i) store(pixel + ivec2(i & 1, i >> 1), 1.0, wanted);
      }
    }
    return;
  }
  int scale = 1 << level, item = number - slot * items;
  do {
    ivec2 texel = ivec2(item & (side - 1), item >> (4 - level));
    clear();
    // Tested at the end: a processor goes once more through a loop that tests first.
    int blocks = reads ? scale * scale / 4 : 0, block = 0;
    if (reads) do
        add_block(first + texel * scale + 2 * ivec2(block & (scale / 2 - 1), block >> (level - 1)), false, wanted);
      while (++block < blocks);
    store(tile.place * side + texel, float(scale * scale), wanted);
  } while ((item += kThreads) < items);
}
