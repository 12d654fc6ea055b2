// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_DEPTH_OF_FIELD_BLUR_GATHER_GLSL
#define GLOAM_SHADERS_DEPTH_OF_FIELD_BLUR_GATHER_GLSL

#include "shaders/depth_of_field/depth_of_field_shared.h"
#include "shaders/depth_of_field/kernel_api.glsl"
#include "shaders/depth_of_field/near_api.glsl"

// Gathers one layer at the texels of one level of a tile. A texel counts where its own circle reaches, by one over the
// circle's area: the light that it would scatter. Include this after keep() and kept(), which store texels of the layer
// in workgroup memory, or with kKeeps = 0. Thief, section 1.5.2, fetches the texels of a line once; here a workgroup
// fetches those of a block.

layout(local_size_x_id = 2) in;
layout(constant_id = 2) const int kThreads = GLOAM_DOF_THREADS;
layout(constant_id = 1) const uint kNear = 0u;  // 1: the near layer

layout(push_constant, scalar) uniform Level { DofLevel pushed; };
layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1) uniform sampler2D layer_image;
layout(set = 0, binding = 2, rgba16f) uniform writeonly image2D blurred_image;

#define GLOAM_DOF_LIST_BINDING 3
#include "shaders/depth_of_field/blur/layer.glsl"
#include "shaders/depth_of_field/levels_api.glsl"
#include "shaders/depth_of_field/list_api.glsl"

ivec2 size, corner;  // of the level
ivec2 kept_first;    // texel of the level that is kept at place 0
int kept_side;

vec4 fetch_layer(ivec2 texel) { return texelFetch(layer_image, corner + inside_level(texel, size), 0); }
int place_of(ivec2 texel) { return (texel.y - kept_first.y) * kept_side + texel.x - kept_first.x; }
vec4 layer_at(ivec2 texel) { return kKeeps != 0 ? kept(place_of(texel)) : fetch_layer(texel); }

// Four texels, 2 × 2, are gathered together: each texel around them is fetched once.
struct Block {
  vec4 t0, t1, t2, t3;  // upper left, upper right, lower left, lower right
};

// A texel that was not written lies beyond all kernels. It may hold anything.
vec4 written_at(ivec2 texel) {
  vec4 found = layer_at(texel);
  uvec4 exponents = floatBitsToUint(found) & 0x7F800000u;
  bool finite = max(max(exponents.x, exponents.y), max(exponents.z, exponents.w)) != 0x7F800000u;
  return finite ? found : vec4(0.0);
}

// Columns of a row that lie within the square of a distance of one of the block's rows. Loops over them test at their
// end: a processor goes once more through a loop that tests first.
int row_end(int texels, int y) {
  int nearest = y > 0 ? y - 1 : y;
  return int(sqrt(float(max(texels - nearest * nearest, 0)) + 0.25));
}

// What lies behind the texel's surface, or in the same plane, counts as far as the texel's own circle reaches. What
// lies before it covers it. inverse_area: of the other's kernel. Texels behind have one area.
void add_far(vec4 other, float inverse_area, vec2 apart, float own, inout vec4 front, inout vec4 back) {
  float cover = other.a > 0.0 ? aperture_cover(aperture_distance(apart), min(other.a, own)) : 0.0;
  bool before = other.a < own;
  front += (before ? cover * inverse_area : 0.0) * vec4(other.rgb, 1.0);
  back += (before ? 0.0 : cover) * vec4(other.rgb, 1.0);
}
vec4 blurred(float own, vec4 front, vec4 back) {
  front /= max(front.a, 1.0);
  vec3 light = front.rgb + (1.0 - front.a) * back.rgb / max(back.a, 1e-9);
  // Texels in focus have no blurred light.
  return own > 0.0 ? vec4(light, 1.0) * (own / float(GLOAM_DOF_ROOM)) : vec4(0.0);
}
Block blurred_far(ivec2 texel, vec4 own, int texels) {
  Block front = Block(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0)), back = front;
  int taps = int(sqrt(float(texels))), y = -taps;
  do {
    int end = row_end(texels, y), x = -end;
    do {
      vec4 other = written_at(texel + ivec2(x, y));
      float inverse_area = 1.0 / aperture_area(other.a);
      vec2 apart = vec2(x, y);
      add_far(other, inverse_area, apart, own.x, front.t0, back.t0);
      add_far(other, inverse_area, apart - vec2(1.0, 0.0), own.y, front.t1, back.t1);
      add_far(other, inverse_area, apart - vec2(0.0, 1.0), own.z, front.t2, back.t2);
      add_far(other, inverse_area, apart - vec2(1.0, 1.0), own.w, front.t3, back.t3);
    } while (++x <= end + 1);
  } while (++y <= taps + 1);
  return Block(blurred(own.x, front.t0, back.t0), blurred(own.y, front.t1, back.t1), blurred(own.z, front.t2, back.t2),
               blurred(own.w, front.t3, back.t3));
}

// Behind objects before the focus: the light that is visible near them, the nearest most.
void add_fill(vec4 other, float own, ivec2 apart, int texels, inout vec4 fill) {
  int squared = apart.x * apart.x + apart.y * apart.y;
  float weight = 1.0 / (float(squared) + 0.25);
  fill += (lies_behind(own, other.a) && squared <= texels ? weight * weight : 0.0) * vec4(other.rgb, 1.0);
}
vec4 filled(float own, vec4 fill, vec4 light) {
  if (own >= 0.0) return light;
  return fill.a > 0.0 ? vec4(fill.rgb / fill.a, 1.0) * kFilledWeight : vec4(0.0);
}
// texels: as in GatherWork. own_texels: of the tile.
Block filled_far(ivec2 texel, vec4 own, int texels, int own_texels, Block light) {
  Block fill = Block(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
  int taps = int(sqrt(float(texels))), y = -taps;
  do {
    int end = row_end(texels, y), x = -end;
    do {
      vec4 other = written_at(texel + ivec2(x, y));
      ivec2 apart = ivec2(x, y);
      add_fill(other, own.x, apart, own_texels, fill.t0);
      add_fill(other, own.y, apart - ivec2(1, 0), own_texels, fill.t1);
      add_fill(other, own.z, apart - ivec2(0, 1), own_texels, fill.t2);
      add_fill(other, own.w, apart - ivec2(1, 1), own_texels, fill.t3);
    } while (++x <= end + 1);
  } while (++y <= taps + 1);
  return Block(filled(own.x, fill.t0, light.t0), filled(own.y, fill.t1, light.t1), filled(own.z, fill.t2, light.t2),
               filled(own.w, fill.t3, light.t3));
}

// The squares of the distances of texels that are read (DofEntry::work). Equal in a workgroup, so that its threads
// leave loops together.
struct GatherWork {
  int texels;
  int fills;
};
GatherWork group_work(uint list, int tiles) {
  GatherWork work = GatherWork(0, 0);
  int i = 0;
  do {
    DofTile tile;
    bool listed = listed_tile(list, list_group() * uint(tiles) + uint(i), tile);
    int own = listed && (tile.work & GLOAM_DOF_EMPTY) == 0 ? tile.work : 0;
    work.texels = max(work.texels, own % GLOAM_DOF_FILLS);
    work.fills = max(work.fills, own / GLOAM_DOF_FILLS);
  } while (++i < tiles);
  return work;
}

Block far_texels(ivec2 texel, GatherWork work, int own_fills) {
  vec4 own = vec4(layer_at(texel).a, layer_at(texel + ivec2(1, 0)).a, layer_at(texel + ivec2(0, 1)).a,
                  layer_at(texel + ivec2(1, 1)).a);
  Block light = blurred_far(texel, own, work.texels);
  // A loop in place of a condition: lavapipe runs both sides of a branch.
  for (int i = 0; i < min(work.fills, 1); ++i) light = filled_far(texel, own, work.fills, own_fills, light);
  return light;
}

// A texel of the near layer: light and share by the area of its kernel, and its radius.
struct NearTexel {
  vec4 light;
  float radius;
};
// own: radius of the texel's own kernel. Texels with much wider ones lie before it (front).
void add_near(NearTexel other, float own, vec2 apart, inout vec4 front, inout vec4 back, inout float radii) {
  float cover = aperture_cover(aperture_distance(apart), other.radius);
  bool before = other.radius > 1.5 * own;
  front += (before ? cover : 0.0) * other.light;
  back += (before ? 0.0 : cover) * other.light;
  radii += cover * other.light.a * other.radius;
}
vec4 covering(vec4 front, vec4 back, float radii) {
  // Few texels do not add up to the area of a disc.
  float radius = max(radii / max(front.a + back.a, 1e-9), 0.5), whole = aperture_area(radius) / aperture_sum(radius);
  return under(under(vec4(0.0), front * whole), back * whole);
}
float own_radius(vec4 texel) { return near_share(texel.a) > 0.0 ? near_radius(texel.a) : 0.0; }
Block near_texels(ivec2 texel, int texels) {
  Block front = Block(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0)), back = front;
  vec4 own = vec4(own_radius(layer_at(texel)), own_radius(layer_at(texel + ivec2(1, 0))),
                  own_radius(layer_at(texel + ivec2(0, 1))), own_radius(layer_at(texel + ivec2(1, 1))));
  vec4 radii = vec4(0.0);
  int taps = int(sqrt(float(texels))), y = -taps;
  do {
    int end = row_end(texels, y), x = -end;
    do {
      vec4 found = written_at(texel + ivec2(x, y));
      float radius = near_radius(found.a), share = near_share(found.a);
      float weight = share > 0.0 ? 1.0 / aperture_area(radius) : 0.0;
      NearTexel other = NearTexel(weight * vec4(found.rgb, share), radius);
      vec2 apart = vec2(x, y);
      add_near(other, own.x, apart, front.t0, back.t0, radii.x);
      add_near(other, own.y, apart - vec2(1.0, 0.0), front.t1, back.t1, radii.y);
      add_near(other, own.z, apart - vec2(0.0, 1.0), front.t2, back.t2, radii.z);
      add_near(other, own.w, apart - vec2(1.0, 1.0), front.t3, back.t3, radii.w);
    } while (++x <= end + 1);
  } while (++y <= taps + 1);
  return Block(covering(front.t0, back.t0, radii.x), covering(front.t1, back.t1, radii.y),
               covering(front.t2, back.t2, radii.z), covering(front.t3, back.t3, radii.w));
}

ivec2 tile_end;  // texel beyond the tile and the level
void store(ivec2 texel, vec4 light, bool empty) {
  if (all(lessThan(texel, tile_end)))
    imageStore(blurred_image, corner + texel, empty ? vec4(0.0) : min(light, vec4(65504.0)));
}

// Keeps the texels that kernels of the tile read.
void keep_texels(ivec2 first, int side, int taps) {
  kept_first = first - taps;
  kept_side = max(side, 2) + 2 * taps;
  for (int i = int(gl_LocalInvocationIndex); i < kept_side * kept_side; i += kThreads)
    keep(i, fetch_layer(kept_first + ivec2(i % kept_side, i / kept_side)));
}

void main() {
  int level = pushed.level, side = GLOAM_DOF_TILE >> level, columns = max(side / 2, 1), blocks = columns * columns;
  // Tiles of few blocks share a workgroup, unless it keeps the texels of one.
  int number = int(gl_LocalInvocationIndex), tiles = dof.gather_tiles[level];
  int slot = kKeeps != 0 ? 0 : number / blocks;
  DofTile tile;
  uint list = uint(level + (kNear != 0u ? GLOAM_DOF_NEAR : GLOAM_DOF_FAR));
  if (!listed_tile(list, list_group() * uint(tiles) + uint(slot), tile)) return;
  size = level_size(level);
  corner = dof.corner[level];
  ivec2 first = tile.place * side;
  tile_end = min(first + side, size);
  bool empty = (tile.work & GLOAM_DOF_EMPTY) != 0;
  int own_fills = empty ? 0 : tile.work / GLOAM_DOF_FILLS;
  GatherWork work = group_work(list, tiles);
  if (kKeeps != 0) {
    keep_texels(first, side, int(sqrt(float(max(work.texels, work.fills)))));
    barrier();
  }
  int block = number - slot * blocks;
  if (block < blocks) do {
      ivec2 texel = first + 2 * ivec2(block % columns, block / columns);
      Block light = kNear != 0u ? near_texels(texel, work.texels) : far_texels(texel, work, own_fills);
      store(texel, light.t0, empty);
      store(texel + ivec2(1, 0), light.t1, empty);
      store(texel + ivec2(0, 1), light.t2, empty);
      store(texel + ivec2(1, 1), light.t3, empty);
    } while ((block += kThreads) < blocks);
}

#endif
