// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/gpu/types.h"

namespace gloam {

struct Picture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;  ///< sRGB-encoded, rows from the top
};
struct LinearPicture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<float> rgba;  ///< linear light before exposure, cd/m², rows from the top
};
/// Texels of a GPU image, first mip and layer.
struct ImageBytes {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  gpu::Format format = gpu::Format::undefined;
  std::vector<std::byte> bytes;  ///< texels, rows from the top, tightly packed
};

}  // namespace gloam
