// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/core/result.h"
#include "engine/scene/assets.h"

namespace gloam {

/// Widest and highest image that is read.
inline constexpr std::uint32_t kMaxImageSide = 16384;

struct ImageSize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// What the header of a PNG or JPEG says, checked against what so many bytes can hold at the format's densest. The
/// error is the fault alone.
[[nodiscard]] Result<ImageSize> image_size(std::span<const std::uint8_t> file);

/// Decodes a PNG or JPEG to 8-bit RGBA (16-bit channels are rounded down). Memory beyond the picture itself stays in
/// proportion to it. The error is the fault alone.
[[nodiscard]] Result<Image> decode_image(std::span<const std::uint8_t> file);

}  // namespace gloam
