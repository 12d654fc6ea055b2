// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "engine/core/result.h"
#include "engine/scene/assets.h"

namespace gloam {

/// Largest accepted width and height of an image, in pixels.
inline constexpr std::uint32_t kMaxImageSide = 16384;

struct ImageSize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// Size from the header of a PNG or JPEG. Input error if the file is neither, its header is damaged, a side exceeds
/// kMaxImageSide, or it states more pixels than its bytes can hold at the format's best compression. The message holds
/// only the fault, not the place.
[[nodiscard]] Result<ImageSize> image_size(std::span<const std::uint8_t> file);

/// Decodes a PNG or JPEG to 8-bit RGBA (16-bit channels are rounded down). Uses memory in proportion to the size of the
/// image. An error's message holds only the fault, not the place.
[[nodiscard]] Result<Image> decode_image(std::span<const std::uint8_t> file);

/// Reads and decodes a file. An error's message holds only the fault, not the path.
[[nodiscard]] Result<Image> read_image_file(const std::string& path);

}  // namespace gloam
