// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "modules/accuracy/metrics/pixels.h"

// LDR-FLIP: P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. D. Fairchild, "FLIP: A Difference
// Evaluator for Alternating Images", HPG 2020, with the constants of version 1.6. Every filter is applied as
// one-dimensional passes, in double precision.

namespace gloam {

/// A display of 3840 pixels on 0.7 m, seen from 0.7 m: 0.7 · (3840 / 0.7) · π / 180.
inline constexpr double kFlipPixelsPerDegree = 67.02064327658226;

/// Features that FLIP compares: colours after the contrast sensitivity filter, and the strength of edges and points. A
/// reference that many pictures are compared with is prepared once.
struct FlipFeatures {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  double pixels_per_degree = 0.0;
  std::vector<float> lightness;  ///< L*; one value per pixel, as in all vectors here
  std::vector<float> a;          ///< a* and b*, Hunt-adjusted
  std::vector<float> b;
  std::vector<float> edges;
  std::vector<float> points;
};

/// `pixels_per_degree`: > 0, at most 1000.
[[nodiscard]] FlipFeatures flip_features(const EncodedPixels& picture, double pixels_per_degree = kFlipPixelsPerDegree);

/// Perceived difference of each pixel, 0…1. Both must have the same size and pixels_per_degree.
[[nodiscard]] std::vector<float> flip_error_map(const FlipFeatures& reference, const FlipFeatures& test);

}  // namespace gloam
