// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace gloam {

/// Pixels of a picture, rows from the top: width · height · 4 numbers. The fourth number of each pixel is ignored.
template <class T>
struct Pixels {
  std::uint32_t width = 0;   ///< > 0
  std::uint32_t height = 0;  ///< > 0
  std::span<const T> rgba;

  [[nodiscard]] std::size_t count() const { return std::size_t{width} * height; }
  [[nodiscard]] bool whole() const { return count() > 0 && rgba.size() == count() * 4; }
  [[nodiscard]] bool same_size(const Pixels& other) const { return width == other.width && height == other.height; }
};

using EncodedPixels = Pixels<std::uint8_t>;  ///< sRGB-encoded
using LinearPixels = Pixels<float>;          ///< linear light

}  // namespace gloam
