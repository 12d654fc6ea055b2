// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_SORT_BLOCK_GLSL
#define GLOAM_SHADERS_RENDER_SORT_BLOCK_GLSL

// Counters of a workgroup that handles one column: 256 bins of 16 bits for each thread, two bins to a word (row). The
// includer declares c and keys.

const uint kBlockThreads = GLOAM_SORT_BLOCK_THREADS;
shared uint rows[GLOAM_SORT_BINS / 2 * GLOAM_SORT_BLOCK_THREADS];

// Index of a thread's word. Rows are rotated, so that threads that walk along different rows meet different banks.
uint word_at(uint row, uint thread) { return row * kBlockThreads + (thread ^ (row >> 1 & (kBlockThreads - 1u))); }

uint first_key(uint thread) { return (gl_WorkGroupID.x * kBlockThreads + thread) * GLOAM_SORT_THREAD_KEYS; }

uvec4 keys_from(uint at) { return at < c.count ? keys[at >> 4] : uvec4(0u); }

uint key_of(uvec4 words, uint j) { return words[j >> 2] >> (8u * (j & 3u)) & 0xFFu; }

// Sets the thread's counters to the numbers of its keys.
void count_keys(uint thread) {
  for (uint row = 0u; row < GLOAM_SORT_BINS / 2u; ++row) rows[word_at(row, thread)] = 0u;
  for (uint i = 0u; i < GLOAM_SORT_THREAD_KEYS; i += 16u) {
    uint at = first_key(thread) + i;
    uvec4 words = keys_from(at);
    for (uint j = 0u; j < 16u; ++j) {
      uint key = key_of(words, j);
      if (at + j < c.count) rows[word_at(key >> 1, thread)] += 1u << (16u * (key & 1u));
    }
  }
}

#endif
