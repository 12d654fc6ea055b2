// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace gloam {

/// Mips down to 1×1.
[[nodiscard]] std::uint32_t mip_count(std::uint32_t width, std::uint32_t height);

/// Bytes of all mips of an RGBA8 image.
[[nodiscard]] std::size_t mip_chain_bytes(std::uint32_t width, std::uint32_t height);

/// Writes all mips of an RGBA8 image into `chain`, one behind the other, without reading it: it may be memory that is
/// slow to read. Each texel is the mean of the 2×2 above it: of an odd size the last row or column is left out, and a
/// side of one texel counts twice. Colours of sRGB images are averaged in linear light, alpha as it is.
void build_mip_chain(std::span<const std::uint8_t> rgba, std::uint32_t width, std::uint32_t height, bool srgb,
                     std::span<std::byte> chain);

}  // namespace gloam
