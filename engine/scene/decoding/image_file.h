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
  std::uint32_t scans = 1;  ///< passes over the pixels that decoding takes; above 1 for a progressive JPEG

  [[nodiscard]] std::uint64_t pixels() const { return std::uint64_t{width} * height; }
  /// Pixel visits of decoding.
  [[nodiscard]] std::uint64_t work() const { return pixels() * scans; }
};

/// Largest accepted ImageSize::work() of images whose files have this many bytes in total.
[[nodiscard]] constexpr std::uint64_t decoding_work_limit(std::uint64_t bytes) {
  return (std::uint64_t{1} << 30) + 256 * bytes;
}

/// Size from the header of a PNG, JPEG or WebP. Input error if the file is none of them, its header is damaged, it is
/// an animated WebP, a side exceeds kMaxImageSide, it is a PNG or JPEG that states more pixels than its bytes can hold
/// at the format's best compression, or its scans exceed decoding_work_limit. The message holds only the fault, not the
/// place.
[[nodiscard]] Result<ImageSize> image_size(std::span<const std::uint8_t> file);

/// Decodes a PNG, JPEG or WebP to 8-bit RGBA (16-bit channels are rounded down). Uses memory in proportion to the size
/// of the image. An error's message holds only the fault, not the place.
[[nodiscard]] Result<Image> decode_image(std::span<const std::uint8_t> file);

/// Reads and decodes a file. An error's message holds only the fault, not the path.
[[nodiscard]] Result<Image> read_image_file(const std::string& path);

}  // namespace gloam
