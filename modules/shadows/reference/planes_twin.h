// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Planes of shadow maps in double precision: the twin of planes.comp, and faces of random relief.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "engine/math/types.h"
#include "shaders/shadows/maps/planes_shared.h"

namespace gloam {

inline constexpr std::uint32_t kPlaneBlock = GLOAM_SHADOW_PLANE_BLOCK;

/// A face in the atlas and its depths, row by row.
struct PlaneFace {
  uvec2 origin;
  std::uint32_t size;
  std::vector<float> depths;

  [[nodiscard]] double depth(uvec2 texel) const {
    return static_cast<double>(depths[std::size_t{texel.y} * size + texel.x]);
  }
  /// Blocks per side; 0 if the face is smaller than a block of this level.
  [[nodiscard]] std::uint32_t blocks(std::uint32_t level) const { return size / GLOAM_SHADOW_PLANE_BLOCK >> level; }
};

/// Calls use(texel) for all texels of a square.
template <class Use>
void for_square(std::uint32_t side, const Use& use) {
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) use(uvec2(x, y));
}

/// Calls use(level, block) for all blocks of a face.
template <class Use>
void for_blocks(const PlaneFace& face, const Use& use) {
  for (std::uint32_t level = 0; level < GLOAM_SHADOW_PLANE_LEVELS; ++level)
    for_square(face.blocks(level), [&](uvec2 block) { use(level, block); });
}

/// From the middle of a square of this many texels to one of its texels.
[[nodiscard]] inline glm::dvec2 from_middle(uvec2 texel, std::uint32_t side) {
  return glm::dvec2(texel) - 0.5 * (side - 1.0);
}

/// Depth of a plane at an offset from the middle of its block.
[[nodiscard]] inline double plane_depth(const dvec4& plane, glm::dvec2 offset) {
  return plane.x + plane.y * offset.x + plane.z * offset.y;
}

/// Bound on the rounding of a plane anywhere in its block. nearest: of the block. Planes are at most 5 · 2^level times
/// as high as the nearest depth. A level rounds fewer than ten such values to 24 bits and inherits the errors of the
/// finer levels.
[[nodiscard]] inline double plane_rounding(double nearest, std::uint32_t level) {
  return std::ldexp(nearest, static_cast<int>(level) - 18);
}
/// Bound on the rounding of a slope: a sum of 64 depths times at most 3.5, divided by 336.
[[nodiscard]] inline double slope_rounding(double nearest) { return std::ldexp(nearest, -20); }
/// Bound on the rounding of a height whose slopes are rounded, too.
[[nodiscard]] inline double height_rounding(double nearest, std::uint32_t level) {
  return std::ldexp(nearest, static_cast<int>(level) - 16);
}

/// All levels of a face, blocks row by row.
[[nodiscard]] std::vector<std::vector<dvec4>> expected_planes(const PlaneFace& face);

enum class Relief { flat, slanted, steps, empty, holes, noise, spike, faint, bright, saw, count };

[[nodiscard]] inline std::uint32_t random_below(std::mt19937& random, std::uint32_t end) {
  return static_cast<std::uint32_t>(random() % end);
}
[[nodiscard]] inline uvec2 random_below(std::mt19937& random, uvec2 end) {
  return {random_below(random, end.x), random_below(random, end.y)};
}
/// Overwrites a rectangle of a face.
void paint_relief(PlaneFace& face, uvec2 begin, uvec2 end, Relief relief, std::mt19937& random);
/// One relief with rectangles of others.
[[nodiscard]] PlaneFace random_face(uvec2 origin, std::uint32_t size, std::mt19937& random);
/// Faces of many sizes that touch each other and the edges of an atlas of kPlaneAtlas.
inline constexpr std::uint32_t kPlaneAtlas = 512;
[[nodiscard]] std::vector<PlaneFace> random_faces(std::mt19937& random);

}  // namespace gloam
