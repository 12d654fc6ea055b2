// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_REPROJECT_GLSL
#define GLOAM_SHADERS_SHADOWS_REPROJECT_GLSL

#include "shaders/shadows/final_lists/reproject_shared.h"

// Takes visibilities of the frame before from where its camera saw the same points (shadows.reuse=reprojected). A tile
// finds for each of its pixels the pixel of the frame before that shows the same surface. If all are found, in at most
// 2 x 2 tiles whose lists are complete, a light of the tile takes its visibilities from there, unless
//   - the light has changed, or
//   - later modules have changed its visibilities there (close-ups), or
//   - a caster that has moved may stand between the tile and the light.
// Each frame makes a quarter of the tiles anew, so errors last for at most three frames.
//
// The errors are those of position, up to half a pixel a frame, and of casters, whose sphere is larger than they are,
// but knows nothing of the width of a filter's kernel.

// No uniform block: lavapipe 22.3 crashes when it makes constants of the block's conditions.
layout(set = 0, binding = 35, scalar) readonly buffer Reproject { ReprojectBlock reproject; };
layout(set = 0, binding = 36, scalar) readonly buffer Sources { uint sources[]; };  // of find_sources.comp.glsl

// What a tile takes from the frame before.
struct TileSource {
  bool found;    // false: nothing
  uint pixels;   // index of its first item in `sources`
  uvec2 first;   // the tile at the least x and y that its pixels come from
  uvec2 shift;   // if all pixels are moved alike: the place of its first pixel, from `first`; else kNoShift
  uint used;     // bit i: pixels come from tile first + (i & 1, i >> 1)
  vec3 centre;   // of the box around its surfaces, camera-relative
  float radius;  // of a sphere around that box
};

const uvec2 kNoShift = uvec2(16u);
KeptRun source_runs[8];  // of the four tiles that pixels may come from: of local lights, then of directional ones

TileSource find_source(uvec2 tile, uint tile_index, vec2 depths) {
  TileSource s = TileSource(false, tile_index << 6, uvec2(0u), kNoShift, 1u, vec3(0.0), 0.0);
  if (sources[s.pixels] == GLOAM_NO_SOURCE) return s;  // mostly the tile is in turn
  bool found = true, alike = true;
  uvec2 origin = uvec2(0u);  // where the tile's first pixel comes from; wraps around below 0
  uvec2 low = uvec2(0xFFFFu), high = uvec2(0u);
  for (uint i = 0u; i < uint(GLOAM_SLOT_PIXELS); ++i) {
    uint source = sources[s.pixels + i];
    bool surface = source != GLOAM_NO_SURFACE;
    found = found && source != GLOAM_NO_SOURCE;
    uvec2 from = uvec2(source & 0xFFFFu, source >> 16);
    uvec2 would_be = from - uvec2(i & 7u, i >> 3);
    origin = i == 0u ? would_be : origin;
    alike = alike && surface && would_be == origin;
    low = surface ? min(low, from) : low;
    high = surface ? max(high, from) : high;
  }
  uvec2 first = low >> 3, last = high >> 3;
  s.found = found && low.x <= high.x && all(lessThanEqual(last - first, uvec2(1u)));
  if (!s.found) return s;
  s.first = first;
  s.shift = alike ? low & 7u : kNoShift;
  s.used = 1u | (last.x != first.x ? 2u : 0u);
  s.used |= last.y != first.y ? s.used << 2 : 0u;
  vec3 nearest = vec3(1e30), farthest = vec3(-1e30);
  for (uint i = 0u; i < 8u; ++i) {
    vec2 corner = vec2((tile + uvec2(i & 1u, i >> 1 & 1u)) * uint(GLOAM_SHADOW_TILE)) - 0.5;
    vec3 position = relative_position(view, corner, (i & 4u) != 0u ? depths.x : depths.y);
    nearest = min(nearest, position);
    farthest = max(farthest, position);
  }
  s.centre = 0.5 * (nearest + farthest);
  s.radius = 0.5 * length(farthest - nearest);
  return s;
}

// The index of tile first + (i & 1, i >> 1).
uint source_tile(TileSource s, uint i) { return (s.first.y + (i >> 1)) * final_grid.tiles.x + s.first.x + (i & 1u); }

bool uses(TileSource s, uint i) { return (s.used >> i & 1u) != 0u; }

// Whether a caster that has moved may stand, or have stood, between the tile and a light. light_position:
// camera-relative; of a directional light its direction. size_m: radius of the emitter; of a directional light half its
// penumbra's metres per metre.
bool is_touched(TileSource s, bool directional, vec3 light_position, float size_m) {
  bool touched = false;
  for (uint i = 0u; i < reproject.sphere_count; ++i) {
    vec3 caster = reproject.spheres[i].xyz - s.centre, to_light = light_position - s.centre;
    float along = directional ? max(-dot(caster, light_position), 0.0)
                              : clamp(dot(caster, to_light) / max(dot(to_light, to_light), 1e-30), 0.0, 1.0);
    vec3 nearest = directional ? -along * light_position : along * to_light;
    float reach = reproject.spheres[i].w + s.radius + along * size_m;
    touched = touched || distance(caster, nearest) <= reach;
  }
  return touched;
}

// Whether the light's visibilities may come from the frame before. last: the light's item of last_indices.
bool may_come(TileSource s, bool directional, uint light, uint last) {
  if (!s.found || last == GLOAM_LIGHT_CHANGED) return false;
  uint bit = kept_light_bit(directional, last & GLOAM_LAST_INDEX);
  bool composed = false;
  for (uint i = 0u; i < 4u; ++i)
    composed = composed || (uses(s, i) && (last_tiles[uses(s, i) ? source_tile(s, i) : 0u].composed & bit) != 0u);
  if (composed) return false;
  if ((last & GLOAM_LIGHT_CASTERS_MOVED) == 0u) return true;
  if (directional) {
    vec3 direction = texelFetch(shadow_rows, ivec2(6, cascade_row(light, 0u)), 0).xyz;
    return !is_touched(s, true, direction, 0.5 * fetch_sun(light).y);
  }
  float emitter_m = 0.5 * max(texelFetch(shadow_rows, ivec2(0, light), 0).z, 0.0);
  return !is_touched(s, false, fetch_light(light_texels, light).position, emitter_m);
}

// Whether the tiles that the tile's pixels come from have lists that may be searched.
bool has_lists(TileSource s) {
  bool complete = true;
  for (uint i = 0u; i < 4u; ++i) {
    uint at = uses(s, i) ? source_tile(s, i) : source_tile(s, 0u);
    complete = complete && last_tiles[at].local_first != GLOAM_NO_FINAL_LIST &&
               (last_tiles[at].counts & 0xFFFFu) <= GLOAM_MOST_KEPT_LIGHTS &&
               last_tiles[at].counts >> 16 <= GLOAM_MOST_KEPT_LIGHTS;
  }
  return complete;
}

TileSource tile_source(uvec2 tile, uint tile_index, vec2 depths) {
  TileSource s = find_source(tile, tile_index, depths);
  s.found = s.found && has_lists(s);
  for (uint i = 0u; i < 4u; ++i) {
    KeptTile last = last_tiles[uses(s, i) ? source_tile(s, i) : 0u];
    bool read = s.found && uses(s, i);
    source_runs[i] = KeptRun(last.local_first, read ? last.counts & 0xFFFFu : 0u, 0u, 0u, 0u);
    source_runs[4u + i] = KeptRun(last.directional_first, read ? last.counts >> 16 : 0u, 0u, 0u, 0u);
  }
  return s;
}

// A word of a tile of the frame before.
uint last_word(uint slot, uint i) {
  const uint words = 2u * kVisibilityBits, per_buffer = GLOAM_BUFFER_WORDS / words;
  bool stored = slot < GLOAM_NO_ROOM, second = stored && slot >= per_buffer;
  uint word = last_visibilities_0[stored && !second ? slot * words + i : 0u];
  if (second) word = last_visibilities_1[(slot - per_buffer) * words + i];
  return stored ? word : slot == GLOAM_ALL_LIT ? 0xFFFFFFFFu : 0u;
}

// Word i of a tile whose pixels are moved alike. slots: of the tiles, by source_tile().
uint shifted_word(uvec2 shift, uvec4 slots, uint i) {
  const uint row_words = kVisibilityBits / 4u, per_word = 8u / row_words;
  uint y = i / row_words + shift.y, x = (i % row_words) * per_word + shift.x, below = (y >> 3) * 2u;
  uint row = (y & 7u) * row_words, first = x / per_word, bit = (x % per_word) * kVisibilityBits, last = first + 1u;
  // Software devices also index for threads that are elsewhere, whose values may be anything.
  uint low = last_word(slots[(below | first / row_words) & 3u], row + first % row_words);
  uint high = last_word(slots[(below | min(last / row_words, 1u)) & 3u], row + last % row_words);
  return bit == 0u ? low : low >> bit | high << (32u - bit);
}

// Word i of any other tile.
uint gathered_word(TileSource s, uvec4 slots, uint i) {
  const uint most = (1u << kVisibilityBits) - 1u, per_word = 32u / kVisibilityBits;
  uint word = 0u;
  for (uint k = 0u; k < per_word; ++k) {
    uint source = sources[s.pixels + i * per_word + k];
    uvec2 from = uvec2(source & 0xFFFFu, source >> 16) - s.first * uint(GLOAM_SHADOW_TILE);
    uint bit = ((from.y & 7u) << 3 | (from.x & 7u)) * kVisibilityBits;
    uint steps = last_word(slots[(from.y >> 3 & 1u) << 1 | (from.x >> 3 & 1u)], bit >> 5) >> (bit & 31u) & most;
    word |= (source == GLOAM_NO_SURFACE ? 0u : steps) << (k * kVisibilityBits);
  }
  return word;
}

// The slot of a light that may_come(), which had the index `last`: a new one with its visibilities of the frame before,
// GLOAM_ALL_LIT or GLOAM_ALL_UNLIT.
uint reprojected_slot(TileSource s, bool directional, uint last, uint tile_index) {
  uvec4 slots = uvec4(GLOAM_ALL_UNLIT);
  bool lit = true, unlit = true;
  for (uint i = 0u; i < 4u; ++i) {
    if (!uses(s, i)) continue;
    slots[i] = last_slot(source_runs[(directional ? 4u : 0u) + i], last & GLOAM_LAST_INDEX);
    lit = lit && slots[i] == GLOAM_ALL_LIT;
    unlit = unlit && slots[i] == GLOAM_ALL_UNLIT;
  }
  if (lit || unlit) return lit ? GLOAM_ALL_LIT : GLOAM_ALL_UNLIT;
  uint to = take_free_slot_of(tile_index);
  if (to == GLOAM_NO_ROOM) return to;
  const uint words = 2u * kVisibilityBits;
  uint least = 0xFFFFFFFFu, most = 0u;
  for (uint i = 0u; i < words; ++i) {
    uint word;
    if (s.shift != kNoShift)
      word = shifted_word(s.shift, slots, i);
    else
      word = gathered_word(s, slots, i);
    least &= word;
    most |= word;
    write_word(to, i, word);
  }
  // The slot is then left unused.
  if (most == 0u) return GLOAM_ALL_UNLIT;
  return least == 0xFFFFFFFFu ? GLOAM_ALL_LIT : to;
}

#endif
