// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/levels/levels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/assert.h"

namespace gloam {
namespace {

constexpr int kLevels = GLOAM_DOF_LEVELS;
constexpr float kKnobLines = 360.0f;  ///< height of the picture that dof.radius is for

/// Radii in pixels at which circles pass to the next level. At half resolution level 0 is not used, and kernels have up
/// to 13 texels; at full resolution up to 21.
struct LevelPasses {
  std::array<float, kLevels - 1> from_px;
  std::array<float, kLevels - 1> to_px;
};
constexpr LevelPasses kHalfPasses = {{0.0f, 3.8f, 7.6f, 15.2f}, {0.5f, 4.0f, 8.0f, 16.0f}};
constexpr LevelPasses kFullPasses = {{2.0f, 4.4f, 8.8f, 17.6f}, {2.3f, 5.0f, 10.0f, 20.0f}};
constexpr float kGreatestAtLast_px = 185.0f;  ///< a kernel of the last level has GLOAM_DOF_MOST_TAPS
constexpr float kCoarserLimits = 4.0f;        ///< circles stop at this many limits
constexpr float kInner = 0.8660254f;          ///< kernel_api.glsl

void set_circles(const uvec2& size, const DofKnobs& knobs, shaders::DofConstants& c) {
  const float limit = std::max(knobs.radius * static_cast<float>(size.y) / kKnobLines, 0.5f);
  const LevelPasses& passes = knobs.full_resolution ? kFullPasses : kHalfPasses;
  c.first_level = knobs.full_resolution ? 0 : 1;
  c.limit = limit;
  c.radius = std::min(kCoarserLimits * limit, kGreatestAtLast_px);
  c.last_level = kLevels - 1;
  c.from[kLevels - 1] = 0.0f;  // not used
  c.to[kLevels - 1] = 1.0f;
  for (int k = 0; k < kLevels - 1; ++k) {
    c.from[k] = passes.from_px[static_cast<std::size_t>(k)];
    c.to[k] = passes.to_px[static_cast<std::size_t>(k)];
    if (c.to[k] < c.radius || k < c.first_level) continue;
    c.last_level = k;
    break;
  }
}

}  // namespace

double dof_kernel_radius(Bokeh bokeh, double circle_px, int level) {
  const bool round = bokeh == Bokeh::round;
  const double inner = round ? 1.0 : static_cast<double>(kInner);
  if (level == 0) return std::max(inner * circle_px, 0.5);
  const double texels = circle_px / static_cast<double>(1 << level);
  return std::max(inner * std::sqrt(std::max(texels * texels - (round ? 1.0 : 1.2), 0.0)), 0.5);
}

int dof_texels(Bokeh bokeh, double kernel_radius) {
  const double across = bokeh == Bokeh::round ? 1.0 : 1.0 / static_cast<double>(kInner);
  const double edge = (kernel_radius + 0.5625) * across * 1.001;
  return static_cast<int>(std::ceil(edge * edge)) - 1;
}

uvec2 set_dof_levels(const uvec2& size, const DofKnobs& knobs, Bokeh bokeh, shaders::DofConstants& c) {
  c.size = size;
  c.tiles = (size + std::uint32_t{GLOAM_DOF_TILE} - 1u) / std::uint32_t{GLOAM_DOF_TILE};
  c.inverse_size = 1.0f / vec2(size);
  set_circles(size, knobs, c);
  uvec2 layers(1);
  std::uint32_t down = 0, across = 0;
  for (int k = c.first_level; k <= c.last_level; ++k) {
    const std::uint32_t scale = 1u << k;
    const uvec2 level = (size + scale - 1u) / scale;
    // The finest level is to the left of all others.
    c.corner[k] = k == c.first_level ? glm::ivec2(0) : glm::ivec2(static_cast<int>(layers.x), static_cast<int>(down));
    if (k > c.first_level) down += level.y;
    if (k == c.first_level) layers = level;
    if (k == c.first_level + 1) across = level.x;
    // The near layer has wider kernels.
    const float greatest =
        k == c.last_level ? c.radius : std::min(c.radius, static_cast<float>(GLOAM_DOF_NEAR_FINER) * c.to[k]);
    const int texels = dof_texels(bokeh, dof_kernel_radius(bokeh, static_cast<double>(greatest), k));
    c.taps[k] = static_cast<int>(std::sqrt(static_cast<double>(texels)));
    GLOAM_ASSERT(2 * c.taps[k] + std::max(GLOAM_DOF_TILE >> k, 2) <= GLOAM_DOF_ROOM,
                 "a kernel reads texels that are not kept");
  }
  layers = {layers.x + across, std::max(layers.y, down)};
  c.inverse_layers = 1.0f / vec2(layers);
  return layers;
}

}  // namespace gloam
