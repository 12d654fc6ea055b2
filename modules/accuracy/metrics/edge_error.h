// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "modules/accuracy/metrics/pixels.h"
#include "modules/accuracy/metrics/statistics.h"

// The error near edges only. A mean over the whole picture hides it: most pixels are far from all edges.

namespace gloam {

/// Neighbours whose luma (Rec. 709, of encoded colours, 0…1) differs by at least this much have an edge between them:
/// the threshold of the antialiasing.
inline constexpr double kEdgeStep = 0.05;
inline constexpr std::uint32_t kEdgeReach = 2;  ///< pixels beside an edge, to each side

/// Whether each pixel is one of the kEdgeReach pixels to either side of an edge between horizontal or vertical
/// neighbours, or at most kEdgeReach - 1 pixels from one of the two in each direction.
[[nodiscard]] std::vector<bool> near_edges(const EncodedPixels& picture);

struct EdgeStatistics {
  ErrorStatistics flip;
  double psnr_db = 0.0;  ///< infinity: equal at all edges
  double share = 0.0;    ///< of the picture's pixels that are near edges
};

/// Errors over the pixels that `near` marks; none if it marks none. flip: FLIP of each pixel. All are of one size.
[[nodiscard]] std::optional<EdgeStatistics> edge_error(const std::vector<bool>& near, std::span<const float> flip,
                                                       const EncodedPixels& reference, const EncodedPixels& test);

}  // namespace gloam
