// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace gloam {

/// Bytes that unfilter_png_rows may read past the last row.
inline constexpr std::size_t kPngRowPadding = 4;

/// Undoes the filters of the inflated rows of an 8-bit RGB or RGBA image and gives RGB an alpha of 255, in one pass.
/// rows: for each row a filter byte and width · channels bytes; then kPngRowPadding bytes of any value. channels: 3 or
/// 4. rgba: width · height · 4 bytes. Sizes are asserted. False if a filter byte is not one of PNG's.
[[nodiscard]] bool unfilter_png_rows(std::span<const std::uint8_t> rows, std::uint32_t width, std::uint32_t height,
                                     std::uint32_t channels, std::span<std::uint8_t> rgba);

}  // namespace gloam
