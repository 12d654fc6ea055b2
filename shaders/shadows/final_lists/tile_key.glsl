// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_TILE_KEY_GLSL
#define GLOAM_SHADERS_SHADOWS_TILE_KEY_GLSL

#include "shaders/common/hash.glsl"
#include "shaders/common/math.glsl"
#include "shaders/lights/lights_api.glsl"

// Hash of all that visibilities read of the geometry buffer in a shadow tile: depth, both normals, the flags in the
// alpha of the base colour, and, where they count, material, extinction and smooth surface. Include this after
// shadows_api.glsl.

// Never 0. Four hashes of 32 bits, of every fourth pixel each.
uvec4 tile_key(sampler2D depth_image, usampler2D normal_image, sampler2D color_image, sampler2D emissive_image,
               sampler2D material_image, vec2 inverse_size, uvec2 tile) {
  uvec4 state = uvec4(1u, 2u, 3u, 4u);
  ivec2 first = ivec2(tile) * GLOAM_SHADOW_TILE;
  for (int i = 0; i < GLOAM_SHADOW_TILE * GLOAM_SHADOW_TILE / 4; ++i) {
    vec2 corner = vec2(first + 2 * ivec2(i & 3, i >> 2) + 1) * inverse_size;
    state = add_to_key(state, floatBitsToUint(textureGather(depth_image, corner)));
    state = add_to_key(state, textureGather(normal_image, corner, 0));
    state = add_to_key(state, textureGather(normal_image, corner, 1));
    state = add_to_key(state, floatBitsToUint(textureGather(color_image, corner, 3)));
    if (kDimLights != 0u) {
      state = add_to_key(state, floatBitsToUint(textureGather(material_image, corner, 0)));
      state = add_to_key(state, floatBitsToUint(textureGather(material_image, corner, 1)));
      state = add_to_key(state, floatBitsToUint(textureGather(color_image, corner, 0)));
      state = add_to_key(state, floatBitsToUint(textureGather(color_image, corner, 1)));
      state = add_to_key(state, floatBitsToUint(textureGather(color_image, corner, 2)));
    }
    if (kTransmission != 0u) state = add_to_key(state, floatBitsToUint(textureGather(emissive_image, corner, 3)));
    if (kTerminator != 0u) {
      state = add_to_key(state, textureGather(smooth_surface_image, corner, 0));
      state = add_to_key(state, textureGather(smooth_surface_image, corner, 1));
    }
  }
  return state | uvec4(0u, 0u, 0u, 1u);
}

#endif
