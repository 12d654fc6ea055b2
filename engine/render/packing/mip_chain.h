// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace gloam {

/// Number of mips of an image, down to 1×1.
[[nodiscard]] std::uint32_t mip_count(std::uint32_t width, std::uint32_t height);

/// Bytes of all mips of an RGBA8 image.
[[nodiscard]] std::size_t mip_chain_bytes(std::uint32_t width, std::uint32_t height);

/// Writes all mips of an RGBA8 image into `chain`, largest first and tightly packed. Does not read `chain`, which may
/// be memory that is slow to read. Each texel is the mean of 2×2 texels of the next larger mip: the last row or column
/// of an odd size is left out, and a side of one texel counts twice. Colours of sRGB images are averaged in linear
/// light, alpha as stored. rgba: width · height · 4 bytes; chain: mip_chain_bytes (asserted).
void build_mip_chain(std::span<const std::uint8_t> rgba, std::uint32_t width, std::uint32_t height, bool srgb,
                     std::span<std::byte> chain);

}  // namespace gloam
