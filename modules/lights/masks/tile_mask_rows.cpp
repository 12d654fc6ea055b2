// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Inner loops that write the tile masks. For the rect bound they are most of the work and are limited by memory
// bandwidth. There is a portable version, and AVX2 and AVX-512 versions for x86-64.
#include "modules/lights/masks/tile_mask_rows.h"

#include <cstring>

#include "modules/lights/masks/tile_light_masks.h"

#if defined(__x86_64__) && defined(__GNUC__)
#define GLOAM_X86_VECTORS
#include <immintrin.h>
#endif

namespace gloam {
namespace {

void and_row_plain(const std::uint32_t* column_masks, const std::uint32_t* row_mask, std::size_t columns,
                   std::size_t word_count, std::uint32_t* tiles) {
  for (std::size_t c = 0; c < columns; ++c, tiles += GLOAM_MASK_WORDS, column_masks += kTileMaskWords) {
    std::uint32_t groups = 0;
    for (std::size_t w = 0; w < word_count; ++w) {
      const std::uint32_t word = column_masks[w] & row_mask[w];
      tiles[1 + w] = word;
      groups |= (word != 0 ? 1u : 0u) << w;
    }
    tiles[0] = groups;
  }
}

void sum_row_plain(std::uint32_t* toggles, std::size_t columns, std::size_t word_count, std::uint32_t* tiles) {
  std::uint32_t sums[kTileMaskWords] = {};
  for (std::size_t c = 0; c < columns; ++c, tiles += GLOAM_MASK_WORDS, toggles += kTileMaskWords) {
    std::uint32_t groups = 0;
    for (std::size_t w = 0; w < word_count; ++w) {
      sums[w] ^= toggles[w];
      toggles[w] = 0;
      tiles[1 + w] = sums[w];
      groups |= (sums[w] != 0 ? 1u : 0u) << w;
    }
    tiles[0] = groups;
  }
  std::memset(toggles, 0, kTileMaskWords * sizeof(std::uint32_t));
}

#ifdef GLOAM_X86_VECTORS

#define GLOAM_AVX2 __attribute__((target("avx2")))
#define GLOAM_AVX512 __attribute__((target("avx512f")))

/// One bit for each 32-bit lane: whether the lane is not 0.
GLOAM_AVX2 inline std::uint32_t filled(__m256i v) {
  const __m256i empty = _mm256_cmpeq_epi32(v, _mm256_setzero_si256());
  return ~static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(empty))) & 0xFFu;
}

template <int kVectors>
GLOAM_AVX2 void and_row_avx2(const std::uint32_t* column_masks, const std::uint32_t* row_mask, std::size_t columns,
                             std::uint32_t* tiles) {
  const auto* column = reinterpret_cast<const __m256i*>(column_masks);
  const auto* row = reinterpret_cast<const __m256i*>(row_mask);
  for (std::size_t c = 0; c < columns; ++c, tiles += GLOAM_MASK_WORDS, column += 4) {
    auto* out = reinterpret_cast<__m256i*>(tiles + 1);
    std::uint32_t groups = 0;
    for (int v = 0; v < kVectors; ++v) {
      const __m256i words = _mm256_and_si256(_mm256_loadu_si256(column + v), _mm256_loadu_si256(row + v));
      _mm256_storeu_si256(out + v, words);
      groups |= filled(words) << (8 * v);
    }
    tiles[0] = groups;
  }
}

template <int kVectors>
GLOAM_AVX2 void sum_row_avx2(std::uint32_t* toggles, std::size_t columns, std::uint32_t* tiles) {
  auto* toggle = reinterpret_cast<__m256i*>(toggles);
  const __m256i zero = _mm256_setzero_si256();
  __m256i sums[kVectors];
  for (__m256i& sum : sums) sum = zero;
  for (std::size_t c = 0; c < columns; ++c, tiles += GLOAM_MASK_WORDS, toggle += 4) {
    auto* out = reinterpret_cast<__m256i*>(tiles + 1);
    std::uint32_t groups = 0;
    for (int v = 0; v < kVectors; ++v) {
      sums[v] = _mm256_xor_si256(sums[v], _mm256_loadu_si256(toggle + v));
      _mm256_storeu_si256(toggle + v, zero);
      _mm256_storeu_si256(out + v, sums[v]);
      groups |= filled(sums[v]) << (8 * v);
    }
    tiles[0] = groups;
  }
  for (int v = 0; v < 4; ++v) _mm256_storeu_si256(toggle + v, zero);
}

template <int kVectors>
GLOAM_AVX512 void and_row_avx512(const std::uint32_t* column_masks, const std::uint32_t* row_mask, std::size_t columns,
                                 std::uint32_t* tiles) {
  __m512i row[kVectors];
  for (int v = 0; v < kVectors; ++v) row[v] = _mm512_loadu_si512(row_mask + 16 * v);
  for (std::size_t c = 0; c < columns; ++c, tiles += GLOAM_MASK_WORDS, column_masks += kTileMaskWords) {
    std::uint32_t groups = 0;
    for (int v = 0; v < kVectors; ++v) {
      const __m512i words = _mm512_and_si512(_mm512_loadu_si512(column_masks + 16 * v), row[v]);
      _mm512_storeu_si512(tiles + 1 + 16 * v, words);
      groups |= std::uint32_t{_mm512_test_epi32_mask(words, words)} << (16 * v);
    }
    tiles[0] = groups;
  }
}

template <int kVectors>
GLOAM_AVX512 void sum_row_avx512(std::uint32_t* toggles, std::size_t columns, std::uint32_t* tiles) {
  __m512i sums[kVectors];
  const __m512i zero = _mm512_setzero_si512();
  for (__m512i& sum : sums) sum = zero;
  for (std::size_t c = 0; c < columns; ++c, tiles += GLOAM_MASK_WORDS, toggles += kTileMaskWords) {
    std::uint32_t groups = 0;
    for (int v = 0; v < kVectors; ++v) {
      sums[v] = _mm512_xor_si512(sums[v], _mm512_loadu_si512(toggles + 16 * v));
      _mm512_storeu_si512(toggles + 16 * v, zero);
      _mm512_storeu_si512(tiles + 1 + 16 * v, sums[v]);
      groups |= std::uint32_t{_mm512_test_epi32_mask(sums[v], sums[v])} << (16 * v);
    }
    tiles[0] = groups;
  }
  for (int v = 0; v < 2; ++v) _mm512_storeu_si512(toggles + 16 * v, zero);
}

using AndRow = void (*)(const std::uint32_t*, const std::uint32_t*, std::size_t, std::uint32_t*);
using SumRow = void (*)(std::uint32_t*, std::size_t, std::uint32_t*);

#endif

}  // namespace

VectorWidth widest_vectors() {
#ifdef GLOAM_X86_VECTORS
  if (__builtin_cpu_supports("avx512f")) return VectorWidth::avx512;
  if (__builtin_cpu_supports("avx2")) return VectorWidth::avx2;
#endif
  return VectorWidth::plain;
}

void and_tile_row([[maybe_unused]] VectorWidth width, const std::uint32_t* column_masks, const std::uint32_t* row_mask,
                  std::size_t columns, std::size_t word_count, std::uint32_t* tiles) {
#ifdef GLOAM_X86_VECTORS
  if (width == VectorWidth::avx512) {
    (word_count <= 16 ? and_row_avx512<1> : and_row_avx512<2>)(column_masks, row_mask, columns, tiles);
    return;
  }
  if (width == VectorWidth::avx2) {
    static constexpr AndRow kRows[] = {and_row_avx2<1>, and_row_avx2<2>, and_row_avx2<3>, and_row_avx2<4>};
    kRows[(word_count - 1) / 8](column_masks, row_mask, columns, tiles);
    return;
  }
#endif
  and_row_plain(column_masks, row_mask, columns, word_count, tiles);
}

void sum_tile_row([[maybe_unused]] VectorWidth width, std::uint32_t* toggles, std::size_t columns,
                  std::size_t word_count, std::uint32_t* tiles) {
#ifdef GLOAM_X86_VECTORS
  if (width == VectorWidth::avx512) {
    (word_count <= 16 ? sum_row_avx512<1> : sum_row_avx512<2>)(toggles, columns, tiles);
    return;
  }
  if (width == VectorWidth::avx2) {
    static constexpr SumRow kRows[] = {sum_row_avx2<1>, sum_row_avx2<2>, sum_row_avx2<3>, sum_row_avx2<4>};
    kRows[(word_count - 1) / 8](toggles, columns, tiles);
    return;
  }
#endif
  sum_row_plain(toggles, columns, word_count, tiles);
}

}  // namespace gloam
