// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// The spread of scattered light, and the images that approximate it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/math/types.h"

namespace gloam {

/// A Gaussian of the point spread.
struct GlareGaussian {
  double sigma = 0.0;  ///< standard deviation along each axis, in heights of the picture
  double share = 0.0;  ///< of the scattered light
};

/// The point spread of scattered light: Gaussians, each twice as wide as the one before, with shares that fall by the
/// square root of two. Their sum falls with about the distance to the power of -2.5, which is between that of glare
/// near a source and far from it (Vos et al., CIE 135/1, 1999: -3 and -2). The shares sum to 1: what leaves the picture
/// is lost.
[[nodiscard]] const std::array<GlareGaussian, 6>& glare_spread();

/// An image of the pyramid. Its texels cover the picture, and GLOAM_GLARE_MARGIN more beyond each edge.
struct GlareLevel {
  uvec2 size{1};        ///< texels, with the margin
  float weight = 0.0f;  ///< of its blur in the spread; all weights sum to 1
};

/// The images for a picture, from the finest. The texels of each have twice the side of those before.
struct GlareLevels {
  double cell_px = 1.0;       ///< side of the finest texels, at least 1
  glm::dvec2 origin_px{0.0};  ///< of the first cell within the margin: the cells lie symmetrically about the picture
  uvec2 cells{1};             ///< of the finest level, without the margin
  std::vector<GlareLevel> levels;
};

/// Standard deviation of the blur of a level, in its texels.
[[nodiscard]] double glare_level_sigma(std::uint32_t level);

/// picture: pixels, > 0. lines: texels along the picture's height at most, > 0.
[[nodiscard]] GlareLevels glare_levels(uvec2 picture, std::uint32_t lines);

}  // namespace gloam
