// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/math/types.h"

namespace gloam {

/// Where faces are drawn before they move into the atlas: squares of one depth image, which is used batch after batch.
struct ScratchPlan {
  struct Place {
    std::uint32_t item = 0;  ///< index into the sizes
    uvec2 corner = uvec2(0);
  };
  struct Batch {
    std::vector<Place> places;
    std::uint32_t side = 0;  ///< texels from the image's corner that the batch uses, a power of two
  };
  std::uint32_t side = 0;  ///< of the image, texels
  std::vector<Batch> batches;
};

/// sizes: powers of two, in texels. The image is kScratchSide wide, or as wide as the largest.
inline constexpr std::uint32_t kScratchSide = 2048;
[[nodiscard]] ScratchPlan plan_scratch(std::span<const std::uint32_t> sizes);

}  // namespace gloam
