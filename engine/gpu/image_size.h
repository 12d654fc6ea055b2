// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "engine/gpu/types.h"

/// Sizes in bytes of tightly packed images, as copies to and from buffers use them. The image itself may take more
/// memory on a device.
namespace gloam::gpu {

/// The number of mips down to one texel.
[[nodiscard]] inline std::uint32_t full_mip_count(const ImageDesc& desc) {
  return static_cast<std::uint32_t>(std::bit_width(std::max({desc.width, desc.height, desc.depth})));
}
/// Bytes of one layer of one mip.
[[nodiscard]] inline std::uint64_t mip_bytes(const ImageDesc& desc, std::uint32_t mip) {
  return std::uint64_t{std::max(desc.width >> mip, 1u)} * std::max(desc.height >> mip, 1u) *
         std::max(desc.depth >> mip, 1u) * bytes_per_texel(desc.format);
}
/// Bytes of one layer with all its mips.
[[nodiscard]] inline std::uint64_t layer_bytes(const ImageDesc& desc) {
  std::uint64_t bytes = 0;
  for (std::uint32_t mip = 0; mip < desc.mips; ++mip) bytes += mip_bytes(desc, mip);
  return bytes;
}
[[nodiscard]] inline std::uint64_t image_bytes(const ImageDesc& desc) { return layer_bytes(desc) * desc.layers; }

}  // namespace gloam::gpu
