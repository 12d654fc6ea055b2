// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_TILE_GROUPS_GLSL
#define GLOAM_SHADERS_SHADOWS_TILE_GROUPS_GLSL

#include "shaders/common/math.glsl"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/view_api.glsl"
#include "shaders/shadows/final_lists_shared.h"

// The pixels of a shadow tile in one or two groups, so that at an edge each group has one orientation and one plane.
// Sky is left out. Include this after shadows_api.glsl.

struct TileGroups {
  ShadowTileGroup one, two;
  bool has_two;
};

// A pixel of the tile.
struct TilePixel {
  uvec2 at;  // in the tile
  float depth;
  vec3 position;            // camera-relative
  ShadowReceiver receiver;  // where it is judged
  vec3 shading_normal;
  bool subsurface;
  bool transmits;  // light from behind reaches it
};

const uint kNoPixels = 0x03Fu;  // ShadowTileGroup::pixels of an empty group

ShadowTileGroup empty_group() {
  return ShadowTileGroup(vec3(0.0, 1.0, 0.0), 0.0, 0.0, vec2(1e30, -1e30), vec2(1.0, 0.0), kNoPixels);
}

// Widens the bounds of a group by the smooth surface of a pixel.
void add_smooth_surface(inout ShadowTileGroup g, TilePixel p) {
  float along = dot(g.normal, p.receiver.position);
  g.offsets = vec2(min(g.offsets.x, along), max(g.offsets.y, along));
  // Leaves the tile open if a receiver plane may be as steep as least_sine() allows.
  g.spread = max(g.spread, 0.5 * kSmoothSine);
  // Rounded up, and never 0.
  float lift = max(1.001 * distance(p.receiver.position, p.position) + 1e-6, unpackHalf2x16(g.pixels).y);
  g.pixels = (g.pixels & 0xFFFFu) | (packHalf2x16(vec2(0.0, lift)) & 0xFFFF0000u);
}

// Widens the bounds of a group by a pixel, if it belongs to the group.
void add_pixel(inout ShadowTileGroup g, bool belongs, TilePixel p) {
  float along = dot(g.normal, p.position);
  uvec4 pixels = uvec4(g.pixels) >> uvec4(0u, 3u, 6u, 9u) & 7u;
  pixels = uvec4(min(pixels.xy, p.at), max(pixels.zw, p.at));
  uint packed = pixels.x | pixels.y << 3 | pixels.z << 6 | pixels.w << 9 | (g.pixels & ~0xFFFu) |
                (p.subsurface ? GLOAM_GROUP_SUBSURFACE : 0u) | (p.transmits ? GLOAM_GROUP_TRANSMITS : 0u);
  g.spread = belongs ? max(g.spread, length(p.receiver.face_normal - g.normal)) : g.spread;
  g.shading_spread = belongs ? max(g.shading_spread, length(p.shading_normal - g.normal)) : g.shading_spread;
  g.offsets = belongs ? vec2(min(g.offsets.x, along), max(g.offsets.y, along)) : g.offsets;
  g.depths = belongs ? vec2(min(g.depths.x, p.depth), max(g.depths.y, p.depth)) : g.depths;
  g.pixels = belongs ? packed : g.pixels;
  if (kTerminator != 0u && belongs && p.receiver.smooth_surface) add_smooth_surface(g, p);
}

// How far a pixel is from the orientation and the plane of a group: at most 1 for those that fit. plane: dot(normal,
// position) of the group's first pixel. size: of the tile in metres.
float misfit(ShadowTileGroup g, float plane, float size, TilePixel p) {
  const float most_difference = 0.2;
  return max(length(p.receiver.face_normal - g.normal) / most_difference,
             abs(dot(g.normal, p.position) - plane) / size);
}

// The receiver of a pixel, which may be outside of the picture.
ShadowReceiver receiver_at(ViewConstants view, ivec2 at, vec3 position, vec3 face_normal, bool subsurface) {
  return pixel_receiver(position, face_normal, subsurface, min(at, ivec2(view.size) - 1));
}

// A few pixels of the tile give the first group its orientation and its plane. The first pixel that does not fit gives
// them to the second group, and each pixel after it belongs to the group that it fits better.
TileGroups make_tile_groups(ViewConstants view, sampler2D depth_image, usampler2D normal_image, sampler2D color_image,
                            sampler2D emissive_image, uvec2 tile) {
  TileGroups g = TileGroups(empty_group(), empty_group(), false);
  ivec2 first = ivec2(tile) * GLOAM_SHADOW_TILE;
  // The mean of those of four normals that are like the first of them. Normals of pixels without a surface are
  // undefined.
  vec3 sum = vec3(0.0);
  vec2 planes = vec2(0.0);  // of the groups: dot(normal, position) of a pixel
  vec3 at_first = vec3(0.0);
  float size = 1e30;
  for (int i = 0; i < 4; ++i) {
    ivec2 at = min(first + ivec2(2 + 3 * (i & 1), 2 + 3 * (i >> 1)), ivec2(view.size) - 1);
    float depth = texelFetch(depth_image, at, 0).r;
    bool subsurface = texelFetch(color_image, at, 0).a > 0.5;
    vec3 face_normal = unpack_normal(texelFetch(normal_image, at, 0).y);
    vec3 normal = receiver_at(view, at, vec3(0.0), face_normal, subsurface).face_normal;
    bool none = sum == vec3(0.0);
    if (depth > 0.0 && none) {
      at_first = relative_position(view, vec2(at), depth);
      size = distance(at_first, relative_position(view, vec2(at + GLOAM_SHADOW_TILE), depth));
    }
    if (depth > 0.0 && (none || dot(normal, sum) > 0.95 * length(sum))) sum += normal;
  }
  bool has_one = sum != vec3(0.0);
  g.one.normal = has_one ? normalize(sum) : g.one.normal;
  planes.x = dot(g.one.normal, at_first);
  for (int i = 0; i < GLOAM_SHADOW_TILE * GLOAM_SHADOW_TILE / 4; ++i) {
    ivec2 quad = first + 2 * ivec2(i & 3, i >> 2);
    vec2 corner = vec2(quad + 1) * view.inverse_size;
    vec4 depths = textureGather(depth_image, corner);
    uvec4 shading_normals = textureGather(normal_image, corner, 0), normals = textureGather(normal_image, corner, 1);
    vec4 flags = textureGather(color_image, corner, 3);
    vec4 extinctions = kTransmission != 0u ? textureGather(emissive_image, corner, 3) : vec4(0.0);
    for (int k = 0; k < 4; ++k) {
      const ivec2 offsets[4] = ivec2[](ivec2(0, 1), ivec2(1, 1), ivec2(1, 0), ivec2(0, 0));  // in the order of a gather
      ivec2 at = quad + offsets[k];
      bool surface = depths[k] > 0.0 && all(lessThan(at, ivec2(view.size)));
      vec3 position = relative_position(view, vec2(at), max(depths[k], 1e-30));
      TilePixel p = TilePixel(uvec2(at - first), depths[k], position,
                              receiver_at(view, at, position, unpack_normal(normals[k]), flags[k] > 0.5),
                              unpack_normal(shading_normals[k]), flags[k] > 0.5, extinctions[k] > 0.0);
      if (surface && !has_one) {
        g.one.normal = p.receiver.face_normal;
        planes.x = dot(g.one.normal, p.position);
        size = distance(p.position, relative_position(view, vec2(at + GLOAM_SHADOW_TILE), depths[k]));
        has_one = true;
      }
      float from_one = misfit(g.one, planes.x, size, p);
      if (surface && !g.has_two && from_one > 1.0) {
        g.two.normal = p.receiver.face_normal;
        planes.y = dot(g.two.normal, p.position);
        g.has_two = true;
      }
      bool in_one = !g.has_two || from_one <= 1.0 || from_one <= misfit(g.two, planes.y, size, p);
      add_pixel(g.one, surface && in_one, p);
      add_pixel(g.two, surface && !in_one, p);
    }
  }
  // The pixels of the tile's few normals may all fit the second group better.
  if (g.one.depths.y <= 0.0) {
    g.one = g.two;
    g.has_two = false;
  }
  return g;
}

#endif
