// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace gloam {

/// Words of a mask without its group word.
inline constexpr std::size_t kTileMaskWords = 32;

/// The vectors that the functions below use; all write the same.
enum class VectorWidth : std::uint8_t { plain, avx2, avx512 };

/// The widest that this machine has.
[[nodiscard]] VectorWidth widest_vectors();

/// Writes a row of tiles, GLOAM_MASK_WORDS each, whose lights are those of the column and of the row. `column_masks`:
/// 32 words a column; `row_mask`: 32 words. Only the first `word_count` (1…32) words can have lights; others are left
/// alone or made 0.
void and_tile_row(VectorWidth width, const std::uint32_t* column_masks, const std::uint32_t* row_mask,
                  std::size_t columns, std::size_t word_count, std::uint32_t* tiles);

/// Writes a row of tiles from where lights begin and end: a tile's words are the exclusive or of those of `toggles` up
/// to its column, 32 words a column, with one column more than there are tiles. Leaves `toggles` all 0.
void sum_tile_row(VectorWidth width, std::uint32_t* toggles, std::size_t columns, std::size_t word_count,
                  std::uint32_t* tiles);

}  // namespace gloam
