// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/packing/mip_chain.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>

#include "engine/core/assert.h"
#include "engine/math/srgb.h"

namespace gloam {
namespace {

constexpr std::uint32_t kLinearOne = 8191;  // 13 bits of linear light: enough for every 8-bit sRGB step

struct SrgbTables {
  std::array<std::uint16_t, 256> to_linear;
  std::array<std::uint8_t, 4 * kLinearOne + 1> sum_to_srgb;  ///< by the sum of four linear values
};

const SrgbTables& srgb_tables() {
  static const SrgbTables tables = [] {
    SrgbTables t{};
    for (std::size_t i = 0; i < t.to_linear.size(); ++i)
      t.to_linear[i] =
          static_cast<std::uint16_t>(std::lround(srgb_to_linear(static_cast<float>(i) / 255.0f) * kLinearOne));
    for (std::size_t i = 0; i < t.sum_to_srgb.size(); ++i)
      t.sum_to_srgb[i] =
          static_cast<std::uint8_t>(std::lround(linear_to_srgb(static_cast<float>(i) / (4.0f * kLinearOne)) * 255.0f));
    return t;
  }();
  return tables;
}

template <bool kSrgb>
void halve(const std::uint8_t* source, std::uint32_t width, std::uint32_t height, std::uint8_t* target) {
  const SrgbTables& tables = srgb_tables();
  const std::uint32_t target_width = std::max(width / 2, 1u);
  const std::uint32_t target_height = std::max(height / 2, 1u);
  for (std::uint32_t y = 0; y < target_height; ++y) {
    const std::uint8_t* row0 = source + std::size_t{4} * width * std::min(2 * y, height - 1);
    const std::uint8_t* row1 = source + std::size_t{4} * width * std::min(2 * y + 1, height - 1);
    for (std::uint32_t x = 0; x < target_width; ++x) {
      const std::size_t x0 = std::size_t{4} * std::min(2 * x, width - 1);
      const std::size_t x1 = std::size_t{4} * std::min(2 * x + 1, width - 1);
      for (std::size_t c = 0; c < 4; ++c, ++target) {
        const std::uint8_t a = row0[x0 + c], b = row0[x1 + c], d = row1[x0 + c], e = row1[x1 + c];
        if (kSrgb && c < 3)
          *target =
              tables.sum_to_srgb[tables.to_linear[a] + tables.to_linear[b] + tables.to_linear[d] + tables.to_linear[e]];
        else
          *target = static_cast<std::uint8_t>((a + b + d + e + 2) / 4);
      }
    }
  }
}

}  // namespace

std::uint32_t mip_count(std::uint32_t width, std::uint32_t height) {
  return static_cast<std::uint32_t>(std::bit_width(std::max({width, height, 1u})));
}

std::size_t mip_chain_bytes(std::uint32_t width, std::uint32_t height) {
  std::size_t total = 0;
  for (std::uint32_t m = 0; m < mip_count(width, height); ++m)
    total += std::size_t{4} * std::max(width >> m, 1u) * std::max(height >> m, 1u);
  return total;
}

void build_mip_chain(std::span<const std::uint8_t> rgba, std::uint32_t width, std::uint32_t height, bool srgb,
                     std::span<std::byte> chain) {
  GLOAM_ASSERT(rgba.size() == std::size_t{4} * width * height && chain.size() == mip_chain_bytes(width, height),
               "an image and room for its mips");
  std::memcpy(chain.data(), rgba.data(), rgba.size());
  const std::size_t below = chain.size() - rgba.size();
  if (below == 0) return;
  const auto mips = std::make_unique_for_overwrite<std::uint8_t[]>(below);
  const std::uint8_t* source = rgba.data();
  std::uint8_t* target = mips.get();
  for (std::uint32_t m = 1; m < mip_count(width, height); ++m) {
    const std::uint32_t w = std::max(width >> (m - 1), 1u), h = std::max(height >> (m - 1), 1u);
    if (srgb)
      halve<true>(source, w, h, target);
    else
      halve<false>(source, w, h, target);
    source = target;
    target += std::size_t{4} * std::max(w / 2, 1u) * std::max(h / 2, 1u);
  }
  std::memcpy(chain.data() + rgba.size(), mips.get(), below);
}

}  // namespace gloam
