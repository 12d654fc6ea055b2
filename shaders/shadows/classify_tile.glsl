// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_CLASSIFY_TILE_GLSL
#define GLOAM_SHADERS_SHADOWS_CLASSIFY_TILE_GLSL

#include "shaders/shadows/shadows_api.glsl"

// What shadow maps tell of a whole tile and one light, before any pixel is asked.

const uint kUnknown = 0u;
const uint kLit = 1u;
const uint kUnlit = 2u;
const uint kCastsNone = 3u;

struct TileBounds {
  uvec2 at;
};

TileBounds make_tile_bounds(uvec2 at, vec2 bounds) { return TileBounds(at); }

bool casts(bool directional, uint light) {
  return directional ? shadow_block.directional[min(light, 15u)].cascade_count > 0u
                     : texelFetch(shadow_rows, ivec2(0, light), 0).x != float(GLOAM_SHADOW_NONE);
}

uint classify(TileBounds tile, bool directional, uint light) {
  return casts(directional, light) ? kUnknown : kCastsNone;
}

#endif
