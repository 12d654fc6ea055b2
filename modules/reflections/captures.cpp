// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/captures.h"

namespace gloam {

std::size_t CapturedLayers::mip_offset(std::uint32_t mip) const {
  std::size_t offset = 0;
  for (std::uint32_t m = 0; m < mip; ++m) offset += std::size_t{4} * (side >> m) * (side >> m);
  return offset;
}

std::size_t CapturedLayers::layer_halves() const { return mip_offset(mips); }

}  // namespace gloam
