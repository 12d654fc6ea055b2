// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#define GLOAM_FINAL_LISTS_BINDING 8
#include "shaders/common/hash.glsl"
#include "shaders/lighting/lit_tiles_shared.h"
#include "shaders/lights/lights_api.glsl"
#include "shaders/shadows/final_lists_api.glsl"

// Finds the shadow tiles whose light must be computed anew (lighting.reuse): those of which anything that
// deferred_final_lights.glsl reads has changed since the tile was lit last. A tile's key is a hash of all of it. Each
// thread processes one tile.

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 3) const uint kSpecularAmbient = 1u;  // as in deferred.glsl: 2: with far_image

layout(set = 0, binding = 0) uniform sampler2D base_color_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform sampler2D material_image;
layout(set = 0, binding = 3) uniform sampler2D emissive_image;
layout(set = 0, binding = 4) uniform sampler2D depth_image;
layout(set = 0, binding = 5) uniform sampler2D light_texels;
layout(set = 0, binding = 6) uniform sampler2D far_image;
layout(set = 0, binding = 7, scalar) uniform Lights { LightBlock lights; };
layout(set = 0, binding = 12, scalar) readonly buffer CookieKeys { uint cookie_keys[]; };  // of each local light
layout(set = 0, binding = 13, scalar) buffer LitKeys { uvec4 lit_keys[]; };  // of the light that is kept; 0: none
// Whether each tile has changed, 0 or 1; then the runs.
layout(set = 0, binding = 14, scalar) buffer ChangedTiles { uint changed_tiles[]; };
layout(set = 0, binding = 15, scalar) buffer Commands { LitTileCommands commands; };

layout(push_constant, scalar) uniform Push { LitTileConstants push; };

// surface: set if a pixel of the tile shows one.
uvec4 add_pixels(uvec4 key, uvec2 tile, out bool surface) {
  ivec2 first = ivec2(tile) * GLOAM_SHADOW_TILE, last = ivec2(push.size) - 1;
  surface = false;
  for (int i = 0; i < GLOAM_SHADOW_TILE * GLOAM_SHADOW_TILE; ++i) {
    ivec2 at = min(first + ivec2(i % GLOAM_SHADOW_TILE, i / GLOAM_SHADOW_TILE), last);
    float depth = texelFetch(depth_image, at, 0).r;
    surface = surface || depth > 0.0;
    key = mix_into_key(key, uvec4(floatBitsToUint(depth), texelFetch(normal_image, at, 0).xy,
                                  packUnorm4x8(texelFetch(base_color_image, at, 0))));
    vec4 emissive = texelFetch(emissive_image, at, 0);
    key = mix_into_key(key, uvec4(packUnorm4x8(texelFetch(material_image, at, 0)), packHalf2x16(emissive.rg),
                                  packHalf2x16(emissive.ba), 0u));
    if (kSpecularAmbient == 2u) {
      vec3 far = texelFetch(far_image, at * textureSize(far_image, 0) / ivec2(push.size), 0).rgb;
      key = mix_into_key(key, uvec4(packHalf2x16(far.rg), packHalf2x16(vec2(far.b, 0.0)), 0u, 0u));
    }
  }
  return key;
}

// Adds a light's visibilities, not the place where they are stored.
uvec4 add_visibilities(uvec4 key, uint entry) {
  uint slot = entry_slot(entry), words = slot_words(), per_buffer = GLOAM_BUFFER_WORDS / words;
  bool stored = slot < GLOAM_NO_ROOM;
  key = mix_into_key(key, uvec4(entry_light(entry), stored ? 0u : slot, 0u, 0u));
  if (!stored) return key;
  bool second = kVisibilityBuffers > 1u && slot >= per_buffer;
  uint from = (second ? slot - per_buffer : slot) * words;
  for (uint i = from; i < from + words; i += 4u)
    key = mix_into_key(
        key, second ? uvec4(visibilities_1[i], visibilities_1[i + 1u], visibilities_1[i + 2u], visibilities_1[i + 3u])
                    : uvec4(visibilities_0[i], visibilities_0[i + 1u], visibilities_0[i + 2u], visibilities_0[i + 3u]));
  return key;
}

uvec4 add_lights(uvec4 key, FinalList list) {
  key = mix_into_key(key, uvec4(list.directional_count, list.local_count, 0u, 0u));
  for (uint i = 0u; i < list.directional_count; ++i) {
    uint entry = final_entries[list.directional_first + i];
    DirectionalLight light = lights.directional[entry_light(entry)];
    key = add_visibilities(key, entry);
    key = mix_into_key(key, floatBitsToUint(vec4(light.direction, light.half_angle)));
    key = mix_into_key(key, floatBitsToUint(vec4(light.color, 0.0)));
  }
  for (uint i = 0u; i < list.local_count; ++i) {
    uint entry = final_entries[list.local_first + i], light = entry_light(entry);
    key = add_visibilities(key, entry);
    for (int texel = 0; texel < 3; ++texel)
      key = mix_into_key(key, floatBitsToUint(texelFetch(light_texels, ivec2(texel, light), 0)));
    uint cookie = cookie_keys.length() > light ? cookie_keys[light] : 0u;
    key = mix_into_key(key, uvec4(floatBitsToUint(lights.emitter_radius[light >> 2u][light & 3u]), cookie, 0u, 0u));
  }
  return key;
}

void compare(uvec2 tile, uvec2 tiles) {
  if (any(greaterThanEqual(tile, tiles))) return;
  uint index = tile.y * tiles.x + tile.x;
  FinalList list = final_list(tile * uint(GLOAM_SHADOW_TILE));
  bool surface = false;
  uvec4 key = uvec4(0u);
  if (list.complete) {
    key = add_pixels(uvec4(push.inputs, 1u, 2u), tile, surface);
    key = surface ? add_lights(key, list) | uvec4(0u, 0u, 0u, 1u) : uvec4(0u);
  }
  bool changed = surface && (push.kept == 0u || lit_keys[index] != key);
  lit_keys[index] = key;
  changed_tiles[index] = uint(changed);
  if (surface) atomicAdd(commands.counts.x, 1u);
  if (changed) atomicAdd(commands.counts.y, 1u);
}

// A thread whose tile is the first of a run adds the run.
void join(uvec2 tile, uvec2 tiles) {
  if (any(greaterThanEqual(tile, tiles))) return;
  uint index = tile.y * tiles.x + tile.x, in_run = tile.x % GLOAM_LIT_RUN_TILES;
  if (changed_tiles[index] == 0u || (in_run != 0u && changed_tiles[index - 1u] != 0u)) return;
  uint end = min(tile.x - in_run + GLOAM_LIT_RUN_TILES, tiles.x) - tile.x, count = 1u;
  while (count < end && changed_tiles[index + count] != 0u) ++count;
  changed_tiles[tiles.x * tiles.y + atomicAdd(commands.tiles.y, 1u)] = tile.y << 21 | tile.x << 10 | (count - 1u);
}

// One triangle costs less than many rectangles: on software devices the setup of one takes as long as the light of
// about two tiles. The triangle computes light again that is kept: the same.
void choose() {
  uint runs = commands.tiles.y;
  commands.counts.z = runs;
  if (commands.counts.y + 2u * runs <= commands.counts.x) return;
  commands.tiles.y = 0u;
  commands.whole.y = 1u;
}

void main() {
  uvec2 tiles = uvec2(textureSize(final_tiles, 0));
  bool first = gl_GlobalInvocationID == uvec3(0u);
  if (push.step == GLOAM_LIT_TILES_COMPARE) {
    compare(gl_GlobalInvocationID.xy, tiles);
  } else if (first && push.step == GLOAM_LIT_TILES_START) {
    commands = LitTileCommands(uvec4(6u, 0u, 0u, 0u), uvec4(3u, 0u, 0u, 0u), uvec4(0u));
  } else if (push.step == GLOAM_LIT_TILES_JOIN) {
    join(gl_GlobalInvocationID.xy, tiles);
  } else if (first) {
    choose();
  }
}
