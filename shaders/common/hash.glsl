// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_COMMON_HASH_GLSL
#define GLOAM_SHADERS_COMMON_HASH_GLSL

// Hashes of what a tile's pixels are computed from. A hash starts with any state and adds words.

// One step is a bijection of `state` and one of `words`, in each component: four hashes of 32 bits.
uvec4 add_to_key(uvec4 state, uvec4 words) {
  state = (state ^ words) * 0x9E3779B1u;
  return state << 13 | state >> 19;
}

// The same, and then each component depends on all before it: one hash of 128 bits. A bijection of `state` and of
// `words` as a whole.
uvec4 mix_into_key(uvec4 state, uvec4 words) {
  state = add_to_key(state, words);
  state.y += state.x;
  state.z += state.y;
  state.w += state.z;
  state.x ^= state.w;
  return state;
}

#endif
