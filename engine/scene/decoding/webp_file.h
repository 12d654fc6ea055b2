// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/core/result.h"

namespace gloam {

/// Whether the file begins as a WebP.
[[nodiscard]] bool is_webp(std::span<const std::uint8_t> file);

struct WebpSize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// Size from the header of a WebP; at most 16383 pixels a side, which is the format's limit. Input error if the header
/// is damaged or the image is animated. The message holds only the fault, not the place.
[[nodiscard]] Result<WebpSize> webp_size(std::span<const std::uint8_t> file);

/// Decodes a still WebP, lossy or lossless. rgba: exactly width · height · 4 bytes of webp_size(file). False if the
/// file is damaged or ends early.
[[nodiscard]] bool decode_webp(std::span<const std::uint8_t> file, const WebpSize& size, std::span<std::uint8_t> rgba);

}  // namespace gloam
