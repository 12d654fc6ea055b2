// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace gloam {

/// Words of a mask, without the group word.
inline constexpr std::size_t kTileMaskWords = 32;

/// Instruction sets that the functions below can use. All give the same result.
enum class VectorWidth : std::uint8_t { plain, avx2, avx512 };

/// The widest instruction set that this machine supports.
[[nodiscard]] VectorWidth widest_vectors();

/// Writes one row of tiles, GLOAM_MASK_WORDS each: the light words are column mask AND row mask. `column_masks`: 32
/// words per column; `row_mask`: 32 words. Only the first `word_count` (1…32) words may be nonzero; of the remaining
/// words of a tile, each is either left unchanged or set to 0.
void and_tile_row(VectorWidth width, const std::uint32_t* column_masks, const std::uint32_t* row_mask,
                  std::size_t columns, std::size_t word_count, std::uint32_t* tiles);

/// Writes one row of tiles from toggle bits, which mark where lights begin and end: a tile's words are the exclusive or
/// of the toggle words of all columns up to its own. `toggles`: 32 words per column, with one column more than there
/// are tiles; all 0 afterwards. `word_count` as in and_tile_row.
void sum_tile_row(VectorWidth width, std::uint32_t* toggles, std::size_t columns, std::size_t word_count,
                  std::uint32_t* tiles);

}  // namespace gloam
