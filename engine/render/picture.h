// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

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

}  // namespace gloam
