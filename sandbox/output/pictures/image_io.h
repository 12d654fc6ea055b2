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
/// for the file. ErrorKind::failed if the picture is too large or the file cannot be written.
[[nodiscard]] Status write_png(const std::string& path, std::uint32_t width, std::uint32_t height,
                               std::span<const std::uint8_t> rgba);

/// The bytes of a JPEG file; alpha is dropped. rgba: as write_png. quality: 1…100.
[[nodiscard]] Result<std::string> jpeg_bytes(std::uint32_t width, std::uint32_t height,
                                             std::span<const std::uint8_t> rgba, int quality);

/// Writes an EXR with 32-bit R, G and B; alpha is dropped. rgba: linear light, rows from the top, width · height · 4
/// floats.
[[nodiscard]] Status write_exr(const std::string& path, std::uint32_t width, std::uint32_t height,
                               std::span<const float> rgba);

}  // namespace gloam
