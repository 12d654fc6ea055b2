// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/masks/tile_mask_rows.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "modules/lights/masks/tile_light_masks.h"

namespace gloam {
namespace {

std::vector<VectorWidth> widths() {
  std::vector<VectorWidth> all{VectorWidth::plain};
  if (widest_vectors() >= VectorWidth::avx2) all.push_back(VectorWidth::avx2);
  if (widest_vectors() >= VectorWidth::avx512) all.push_back(VectorWidth::avx512);
  return all;
}

/// Random words, many of them 0, and all 0 from `word_count` on in each column.
std::vector<std::uint32_t> random_words(std::size_t columns, std::size_t word_count, std::mt19937& random) {
  std::vector<std::uint32_t> words(columns * kTileMaskWords, 0);
  for (std::size_t i = 0; i < words.size(); ++i)
    if (i % kTileMaskWords < word_count && random() % 2 == 0)
      words[i] = static_cast<std::uint32_t>(random() & random());
  return words;
}

std::vector<std::uint32_t> meant(std::vector<std::uint32_t> tiles) {
  for (std::size_t i = 0; i < tiles.size(); ++i)
    if (i % GLOAM_MASK_WORDS != 0 && (tiles[i - i % GLOAM_MASK_WORDS] >> (i % GLOAM_MASK_WORDS - 1) & 1u) == 0)
      tiles[i] = 0;
  return tiles;
}

TEST(AndTileRow, writes_words_of_column_and_row_with_every_width_of_vectors) {
  std::mt19937 random(1);
  for (const std::size_t columns : {1u, 2u, 7u, 120u}) {
    for (const std::size_t word_count : {1u, 2u, 8u, 9u, 16u, 17u, 24u, 31u, 32u}) {
      const std::vector<std::uint32_t> column_masks = random_words(columns, word_count, random);
      const std::vector<std::uint32_t> row = random_words(1, word_count, random);
      for (const VectorWidth width : widths()) {
        std::vector<std::uint32_t> tiles(columns * GLOAM_MASK_WORDS, 0xDEADBEEF);
        and_tile_row(width, column_masks.data(), row.data(), columns, word_count, tiles.data());
        const std::vector<std::uint32_t> words = meant(tiles);
        for (std::size_t c = 0; c < columns; ++c)
          for (std::size_t w = 0; w < kTileMaskWords; ++w)
            ASSERT_EQ(words[c * GLOAM_MASK_WORDS + 1 + w], column_masks[c * kTileMaskWords + w] & row[w]);
      }
    }
  }
}

TEST(SumTileRow, writes_running_sums_with_every_width_of_vectors_and_leaves_zeros) {
  std::mt19937 random(2);
  for (const std::size_t columns : {1u, 2u, 7u, 120u}) {
    for (const std::size_t word_count : {1u, 2u, 8u, 9u, 16u, 17u, 24u, 31u, 32u}) {
      const std::vector<std::uint32_t> toggles = random_words(columns + 1, word_count, random);
      for (const VectorWidth width : widths()) {
        std::vector<std::uint32_t> used = toggles;
        std::vector<std::uint32_t> tiles(columns * GLOAM_MASK_WORDS, 0xDEADBEEF);
        sum_tile_row(width, used.data(), columns, word_count, tiles.data());
        EXPECT_EQ(used, std::vector<std::uint32_t>(toggles.size(), 0));
        const std::vector<std::uint32_t> words = meant(tiles);
        for (std::size_t w = 0; w < kTileMaskWords; ++w) {
          std::uint32_t sum = 0;
          for (std::size_t c = 0; c < columns; ++c) {
            sum ^= toggles[c * kTileMaskWords + w];
            ASSERT_EQ(words[c * GLOAM_MASK_WORDS + 1 + w], sum) << columns << " columns, word " << w;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace gloam
