// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "engine/core/result.h"

namespace gloam {

/// Writes an RGB PNG; alpha is dropped. rgba: sRGB-encoded, rows from the top, width · height · 4 bytes. The same
/// picture always gives the same file. Uses the fastest compression that still halves the size, because the user waits
/// for the file. ErrorKind::failed if the picture is too large or the file cannot be written. legend_rows: how many of
/// the last rows a legend covers; a text chunk of the file states them.
[[nodiscard]] Status write_png(const std::string& path, std::uint32_t width, std::uint32_t height,
                               std::span<const std::uint8_t> rgba, std::uint32_t legend_rows = 0);
/// The legend_rows that a file of write_png states; 0 for all other files.
[[nodiscard]] std::uint32_t legend_rows_of(std::span<const std::uint8_t> file);

/// The bytes of a JPEG file; alpha is dropped. rgba: as write_png. quality: 1…100.
[[nodiscard]] Result<std::string> jpeg_bytes(std::uint32_t width, std::uint32_t height,
                                             std::span<const std::uint8_t> rgba, int quality);

/// Writes an EXR with 32-bit R, G and B; alpha is dropped. rgba: linear light, rows from the top, width · height · 4
/// floats.
[[nodiscard]] Status write_exr(const std::string& path, std::uint32_t width, std::uint32_t height,
                               std::span<const float> rgba);

}  // namespace gloam
