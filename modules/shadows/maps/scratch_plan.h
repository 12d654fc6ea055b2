// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gloam {

/// Where faces are drawn before they move into the atlas: each fills a layer of a depth image of its own size. So its
/// depth does not depend on what else is drawn, or where it will lie, to the last bit.
struct ScratchPlan {
  struct Batch {
    std::uint32_t size = 0;            ///< texels of a layer's side
    std::vector<std::uint32_t> items;  ///< indices into the sizes, by layer
  };
  std::vector<Batch> batches;
  /// Texels of the largest batch.
  [[nodiscard]] std::uint64_t texels() const;
};

/// Texels of a batch's image, unless one face has more.
inline constexpr std::uint32_t kScratchTexels = 2048 * 2048;
inline constexpr std::uint32_t kMostScratchLayers = 256;

/// sizes: powers of two, in texels. Large ones come first.
[[nodiscard]] ScratchPlan plan_scratch(std::span<const std::uint32_t> sizes);

}  // namespace gloam
