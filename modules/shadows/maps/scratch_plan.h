// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gloam {

/// How faces are drawn before they move into the atlas: each fills one layer of a depth array of the face's size. So a
/// face's depths are bit-identical regardless of the other faces of the frame and of its place in the atlas.
struct ScratchPlan {
  struct Batch {
    std::uint32_t size = 0;            ///< texels of a layer's side
    std::vector<std::uint32_t> items;  ///< by layer: index of the face in `sizes`
  };
  std::vector<Batch> batches;
  /// Texels of all layers of the largest batch.
  [[nodiscard]] std::uint64_t texels() const;
};

/// Most texels of a batch of standard maps.
inline constexpr std::uint32_t kScratchTexels = 1024 * 1024;
inline constexpr std::uint32_t kMostScratchLayers = 256;

/// Sorts faces into batches of one size, the largest size first. sizes: texels of each face's side, powers of two.
/// most_texels: of a batch, unless a single face has more.
[[nodiscard]] ScratchPlan plan_scratch(std::span<const std::uint32_t> sizes,
                                       std::uint32_t most_texels = kScratchTexels);

}  // namespace gloam
