// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"
#include "shaders/depth_of_field/kernel_api.glsl"
#include "shaders/depth_of_field/near_api.glsl"

// Lays the blurred layers over the light, in place, in the listed tiles. A pixel behind the focus shows the levels of
// the far layer that its circle lies in. The near layer covers the pixels that it has spread to by its alpha. What is
// behind it is the far layer, filled in where objects before the focus hide it. Sprites are discs. Pixels in focus that
// nothing reaches keep their light to the bit.

layout(local_size_x_id = 2) in;
layout(constant_id = 2) const int kThreads = GLOAM_DOF_THREADS;
// What is composed. Of GLOAM_DOF_COMPOSE_ONE the first item is that of level 1, the second that of any other level.
layout(constant_id = 1) const uint kKind = GLOAM_DOF_COMPOSE_SPRITES;
layout(constant_id = 3) const uint kFull = 0u;  // 1: level 0 is used
const bool kSprites = kKind == GLOAM_DOF_COMPOSE_SPRITES;
const bool kBoth = kSprites || kKind == GLOAM_DOF_COMPOSE_BOTH;
const bool kFar = kBoth || kKind == GLOAM_DOF_COMPOSE_FAR;
const bool kTwo = kKind == GLOAM_DOF_COMPOSE_TWO, kOne = kKind < GLOAM_DOF_COMPOSE_TWO;
const bool kNearCoarse = kBoth || kKind == GLOAM_DOF_COMPOSE_NEAR;
const bool kNearFine = kNearCoarse || kKind == GLOAM_DOF_COMPOSE_NEAR_FINE;
const bool kFarLevel1 = kFar || kKind == GLOAM_DOF_COMPOSE_ONE;

layout(push_constant, scalar) uniform Level { DofLevel pushed; };  // of one or two levels
layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1) uniform sampler2D depth_image;
layout(set = 0, binding = 2) uniform sampler2D far_image;
layout(set = 0, binding = 3) uniform sampler2D near_image;
layout(set = 0, binding = 4, scalar) readonly buffer Reach { DofTileReach reached[]; };
layout(set = 0, binding = 5, scalar) readonly buffer TileSprites { DofTileSprites tile_sprites[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Sprites { DofSprite sprites[]; };
layout(set = 0, binding = 7, scalar) readonly buffer Reaching { uint reaching[]; };
layout(set = 0, binding = 8, rgba16f) uniform image2D lit_image;

#define GLOAM_DOF_LIST_BINDING 9
#include "shaders/depth_of_field/levels_api.glsl"
#include "shaders/depth_of_field/list_api.glsl"
#include "shaders/depth_of_field/sprites_api.glsl"

DofTileReach reach;
uint first_sprite, sprite_count;
float around;

// Four pixels: 0 and 1 above, 2 and 3 below.
struct Quad {
  vec4 p0, p1, p2, p3;
};
Quad no_quad() { return Quad(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0)); }

vec4 texel_of(sampler2D image, ivec2 texel, ivec2 size, int level) {
  return texelFetch(image, dof.corner[level] + inside_level(texel, size), 0);
}

// A row of texels of level 1, interpolated at the columns of the two pixels that one of them covers.
struct Row {
  vec4 left, right;
};
Row row_of_level_1(sampler2D image, ivec2 texel) {
  ivec2 size = level_size(1);
  vec4 middle = texel_of(image, texel, size, 1);
  return Row(mix(middle, texel_of(image, texel + ivec2(-1, 0), size, 1), 0.25),
             mix(middle, texel_of(image, texel + ivec2(1, 0), size, 1), 0.25));
}
// The four pixels that a texel covers: the rows of texels above it, of it and below it, interpolated.
Quad quad_of_rows(Row above, Row own, Row below) {
  return Quad(mix(own.left, above.left, 0.25), mix(own.right, above.right, 0.25), mix(own.left, below.left, 0.25),
              mix(own.right, below.right, 0.25));
}

// At coarser levels the same four texels lie around all four pixels.
Quad quad_of_level(sampler2D image, ivec2 pixel, int level) {
  vec2 place = (vec2(pixel) + 0.5) / float(1 << level) - 0.5;
  ivec2 texel = ivec2(floor(place)), size = level_size(level);
  vec2 low = place - vec2(texel), high = low + 1.0 / float(1 << level);
  vec4 top_left = texel_of(image, texel, size, level), top_right = texel_of(image, texel + ivec2(1, 0), size, level);
  vec4 left = texel_of(image, texel + ivec2(0, 1), size, level);
  vec4 right = texel_of(image, texel + ivec2(1, 1), size, level);
  vec4 top0 = mix(top_left, top_right, low.x), top1 = mix(top_left, top_right, high.x);
  vec4 bottom0 = mix(left, right, low.x), bottom1 = mix(left, right, high.x);
  return Quad(mix(top0, bottom0, low.y), mix(top1, bottom1, low.y), mix(top0, bottom0, high.y),
              mix(top1, bottom1, high.y));
}

Quad quad_of_pixels(sampler2D image, ivec2 pixel) {
  return Quad(texelFetch(image, pixel, 0), texelFetch(image, pixel + ivec2(1, 0), 0),
              texelFetch(image, pixel + ivec2(0, 1), 0), texelFetch(image, pixel + ivec2(1, 1), 0));
}

// Adds a level's light, by the share that the level has in a pixel. Where circles are smaller than texels, the sharp
// pixel and the texels together have the variance of the circle.
void add_far(inout vec4 sum, vec4 found, LevelRange range, float whole, float circle) {
  float share = clamp((circle * circle - 0.25) * whole, 0.0, 1.0) * level_share(range, circle);
  sum += share > 0.0 && found.a > 0.0 && circle >= kInFocus ? share * vec4(found.rgb / found.a, 1.0) : vec4(0.0);
}
void add_far(inout Quad sum, Quad found, int level, vec4 circles) {
  LevelRange range = level_range(level);
  float scale = float(1 << level), whole = level == 0 ? 1e9 : 1.0 / (scale * scale - 0.25);
  add_far(sum.p0, found.p0, range, whole, circles.x);
  add_far(sum.p1, found.p1, range, whole, circles.y);
  add_far(sum.p2, found.p2, range, whole, circles.z);
  add_far(sum.p3, found.p3, range, whole, circles.w);
}

// level_1: the quad at level 1.
Quad far_light(ivec2 pixel, vec4 circles, Quad level_1) {
  Quad sum = no_quad();
  if (kKind == GLOAM_DOF_COMPOSE_ONE) add_far(sum, level_1, 1, circles);
  if (kKind == GLOAM_DOF_COMPOSE_ONE + 1 || kTwo)
    add_far(sum, quad_of_level(far_image, pixel, pushed.level), pushed.level, circles);
  if (kTwo) add_far(sum, quad_of_level(far_image, pixel, pushed.level + 1), pushed.level + 1, circles);
  if (kFar && kFull != 0u && (reach.far & 1u) != 0u) add_far(sum, quad_of_pixels(far_image, pixel), 0, circles);
  if (kFar && (reach.far & 2u) != 0u) add_far(sum, level_1, 1, circles);
  uint left = reach.far & ~3u;
  if (kFar && left != 0u) do {
      add_far(sum, quad_of_level(far_image, pixel, findLSB(left)), findLSB(left), circles);
      left &= left - 1u;
    } while (left != 0u);  // tested at the end: a processor goes once more through a loop that tests first
  return sum;
}

// Coarser levels have wider circles, so they lie before finer ones.
void add_near(inout Quad sum, Quad found) {
  sum.p0 = under(sum.p0, found.p0);
  sum.p1 = under(sum.p1, found.p1);
  sum.p2 = under(sum.p2, found.p2);
  sum.p3 = under(sum.p3, found.p3);
}
Quad near_light(ivec2 pixel, Quad level_1) {
  Quad sum = no_quad();
  uint left = reach.near & ~3u;
  if (kNearCoarse && left != 0u) do {
      int level = findMSB(left);
      add_near(sum, quad_of_level(near_image, pixel, level));
      left &= ~(1u << level);
    } while (left != 0u);
  if (kNearFine && (reach.near & 2u) != 0u) add_near(sum, level_1);
  if (kNearFine && kFull != 0u && (reach.near & 1u) != 0u) add_near(sum, quad_of_pixels(near_image, pixel));
  return sum;
}

// Light of sprites at a pixel, behind the focus and before it. A surface before a sprite hides it.
void add_sprite(DofSprite sprite, vec2 apart, float radius, float share, float coc, inout vec4 far, inout vec4 near) {
  float cover = share * clamp((radius - aperture_distance(apart)) / sprite.soft + 0.5, 0.0, 1.0);
  float behind = coc <= -kInFocus ? 1.0 : smoothstep(0.5 * sprite.coc, 0.8 * sprite.coc, coc);
  float before = 1.0 - smoothstep(1.25, 1.6, coc / sprite.coc);
  float seen = cover * (sprite.coc > 0.0 ? behind : before);
  far.rgb += sprite.coc > 0.0 ? seen * sprite.light : vec3(0.0);
  near.rgb += sprite.coc > 0.0 ? vec3(0.0) : seen * sprite.light;
}
void add_sprites(ivec2 pixel, vec4 coc, inout Quad far, inout Quad near) {
  if (!kSprites || sprite_count == 0u) return;
  uint i = 0u;
  do {
    DofSprite sprite = sprites[reaching[first_sprite + i]];
    vec2 apart = vec2(pixel) - sprite.place;
    float radius = kernel_radius(abs(sprite.coc), 0), share = 1.0 / soft_aperture_area(radius, sprite.soft);
    add_sprite(sprite, apart, radius, share, coc.x, far.p0, near.p0);
    add_sprite(sprite, apart + vec2(1.0, 0.0), radius, share, coc.y, far.p1, near.p1);
    add_sprite(sprite, apart + vec2(0.0, 1.0), radius, share, coc.z, far.p2, near.p2);
    add_sprite(sprite, apart + vec2(1.0, 1.0), radius, share, coc.w, far.p3, near.p3);
  } while (++i < sprite_count);
}

void compose(ivec2 pixel, float coc, vec4 far, vec4 near, vec3 discs, vec3 near_discs) {
  if (any(greaterThanEqual(uvec2(pixel), dof.size))) return;
  vec4 light = imageLoad(lit_image, pixel);
  bool counts = is_finite(light.rgb), blurred = abs(coc) >= kInFocus;
  vec3 sharp = counts ? light.rgb : vec3(0.0);
  if (kSprites) sharp *= 1.0 - sprite_share(sharp, coc, around);
  // Light that is not finite does not stay in what is blurred. If there is no other light near, it becomes black.
  if (!counts && far.a > 0.0) far /= far.a;
  near /= max(near.a, 1.0);
  vec3 composed = far.rgb + (1.0 - far.a) * sharp + discs;
  // Where nothing behind an object is visible near it, missing light was not finite. The object's own takes its place.
  bool alone = !counts && coc <= -kInFocus && near.a > 1e-4 && far.a <= 0.0;
  composed = alone ? near.rgb / near.a : near.rgb + (1.0 - near.a) * composed;
  composed += near_discs;
  if (far.a > 0.0 || near.a > 0.0 || sprite_count > 0u || (!counts && blurred))
    imageStore(lit_image, pixel, vec4(min(composed, vec3(65504.0)), light.a));
}

void compose_quad(ivec2 pixel, Quad far_1, Quad near_1) {
  // Upper left, upper right, lower left, lower right.
  vec4 depths = textureGather(depth_image, vec2(pixel + 1) * dof.inverse_size).wzxy;
  vec4 coc = clamp(dof.coc_offset + dof.coc_slope * depths, -dof.radius, dof.radius);
  Quad far = far_light(pixel, abs(coc), far_1), near = near_light(pixel, near_1);
  Quad discs = no_quad(), near_discs = no_quad();
  add_sprites(pixel, coc, discs, near_discs);
  compose(pixel, coc.x, far.p0, near.p0, discs.p0.rgb, near_discs.p0.rgb);
  compose(pixel + ivec2(1, 0), coc.y, far.p1, near.p1, discs.p1.rgb, near_discs.p1.rgb);
  compose(pixel + ivec2(0, 1), coc.z, far.p2, near.p2, discs.p2.rgb, near_discs.p2.rgb);
  compose(pixel + ivec2(1, 1), coc.w, far.p3, near.p3, discs.p3.rgb, near_discs.p3.rgb);
}

void main() {
  DofTile tile;
  uint list = uint(GLOAM_DOF_COMPOSE) + (kOne ? uint(GLOAM_DOF_COMPOSE_ONE) : kKind);
  if (!listed_tile(list + (kOne || kTwo ? uint(pushed.level) : 0u), list_group(), tile)) return;
  uint index = uint(tile.place.y) * dof.tiles.x + uint(tile.place.x);
  reach = reached[index];
  around = kSprites ? tile_sprites[index].surroundings : -1.0;
  first_sprite = index * uint(GLOAM_DOF_REACHING_SPRITES + 1) + 1u;
  sprite_count = kSprites ? reaching[first_sprite - 1u] : 0u;
  // A thread composes quads one below another: each reads one further row of texels of level 1.
  int number = int(gl_LocalInvocationIndex), rows = 64 / kThreads, i = 0;
  ivec2 texel = tile.place * (GLOAM_DOF_TILE / 2) + ivec2(number & 7, (number >> 3) * rows);
  Row far_above, far_own, near_above, near_own;
  if (kFarLevel1) {
    far_above = row_of_level_1(far_image, texel - ivec2(0, 1));
    far_own = row_of_level_1(far_image, texel);
  }
  if (kNearFine) {
    near_above = row_of_level_1(near_image, texel - ivec2(0, 1));
    near_own = row_of_level_1(near_image, texel);
  }
  do {
    Quad far = no_quad(), near = no_quad();
    if (kFarLevel1) {
      Row below = row_of_level_1(far_image, texel + ivec2(0, 1));
      far = quad_of_rows(far_above, far_own, below);
      far_above = far_own;
      far_own = below;
    }
    if (kNearFine) {
      Row below = row_of_level_1(near_image, texel + ivec2(0, 1));
      near = quad_of_rows(near_above, near_own, below);
      near_above = near_own;
      near_own = below;
    }
    compose_quad(2 * texel, far, near);
    ++texel.y;
  } while (++i < rows);
}
