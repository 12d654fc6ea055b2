// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "engine/core/result.h"

namespace gloam {

/// Writes sRGB-encoded RGBA, rows from the top, as an RGB PNG (a picture has no holes). rgba: width · height · 4 bytes.
/// The same picture gives the same bytes. Compression is the fastest that still halves a picture: waiting for a file is
/// waiting.
[[nodiscard]] Status write_png(const std::string& path, std::uint32_t width, std::uint32_t height,
                               std::span<const std::uint8_t> rgba);

/// Writes linear light, rows from the top, as an EXR with 32-bit R, G, B. rgba: width · height · 4 floats.
[[nodiscard]] Status write_exr(const std::string& path, std::uint32_t width, std::uint32_t height,
                               std::span<const float> rgba);

}  // namespace gloam
