// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_ANTIALIASING_EDGE_BITS_GLSL
#define GLOAM_SHADERS_LIGHTING_ANTIALIASING_EDGE_BITS_GLSL

// Edges of the picture as bits. Line n of the rows holds the edges between the pixels of rows n − 1 and n, and line n
// of the columns those between columns n − 1 and n. Lines 0 and the last have none. A line has two planes of bits: x
// where the pixel before the edge (above, left) is the brighter one, y where the other one is. The bit of position p of
// a line is number p + 32: each line begins and ends with an empty word.
//
// Bits make the search along an edge a matter of counting ones in two words.

uint line_words(uint length) { return (length + 31u) / 32u + 2u; }

// First word of a line. rows: of the rows of a picture of this size, or of its columns, which lie behind them.
uint first_word(bool rows, uvec2 size, uint line) {
  uint row_words = line_words(size.x);
  return rows ? line * row_words : (size.y + 1u) * row_words + line * line_words(size.y);
}

#endif
